#!/bin/sh
# seeded.sh [WORD] - steps into every trap of test/seeded, in a copy of the tree, and expects the tests to say so.
#
# A trap is a file of sed: what it is, the file it changes, the tests that must fail (make test W=..., `objects`:
# test/pil/pil.sh, `arrows`: tools/lint/arrows.py, or `compiler`: a static assertion). One line for each; fails if one is not caught, or no longer changes its file.
set -eu
o=${O:-out}
tree=$o/seeded
rm -rf $tree
mkdir -p $tree/out
cp -rp Makefile README.md include sim src test tools $tree
[ ! -d "$o/release" ] || cp -rp "$o/release" "$o/gen" $tree/out
log=$(cd "$o" && pwd)/seeded.log
cd $tree
unset MAKEFLAGS MAKELEVEL MFLAGS O
make tests-built >"$log" 2>&1 || { tail -5 "$log" >&2; echo "seeded: the copy does not build" >&2; exit 1; }

field() { sed -n "s/^# $2: //p" "$1"; }
says() {
  case $1 in
  objects) test/pil/pil.sh objects ;;
  arrows) python3 tools/lint/arrows.py ;;
  compiler) make tests-built ;;
  *) make test W="$1" ;;
  esac
}
missed=0 caught=0
for trap in test/seeded/*"${1:-}"*.sed; do
  file=$(field "$trap" file) word=$(field "$trap" test) name=$(basename "$trap" .sed)
  cp -p "$file" before
  sed -i -f "$trap" "$file"
  if cmp -s before "$file"; then
    said="MISSED: it no longer changes $file"
  elif [ "$word" = objects ] && ! command -v arm-none-eabi-gcc >/dev/null; then
    said="skipped: no arm-none-eabi-gcc"
  elif says "$word" >"$log" 2>&1; then
    said="MISSED: everything passes"
  else
    by=$(sed -n 's/^FAILED //p; s/: died (status.*//p' "$log" | head -1)
    [ "$word" != objects ] || by=$(grep -m1 '^pil:' "$log" || tail -1 "$log")
    [ "$word" != arrows ] || by=$(grep -m1 -E '^circle: |: includes ' "$log")
    [ "$word" != compiler ] || by=$(grep -m1 -o 'static assertion failed.*' "$log")
    said="caught by $by"
    [ -n "$by" ] || said="MISSED: it does not build"
  fi
  case $said in MISSED*) missed=$((missed + 1)) ;; caught*) caught=$((caught + 1)) ;; esac
  printf '%-32s %s\n' "$name" "$said"
  cp before "$file" # newer than what was built from the trap
done
echo "$caught caught, $missed missed"
[ $missed = 0 ] && [ $caught -gt 0 ]
