#!/bin/sh
# lint.sh - format, static analysis, headers that compile alone, and the rules of the house.
set -u
bad=0
fail() {
  echo "lint: $*" >&2
  bad=1
}
sources=$(find include src sim test tools -name '*.[ch]' -o -name '*.cpp' -o -name '*.hpp')

clang-format --dry-run -Werror $sources || fail "clang-format: make format mends it"

cppcheck --quiet --error-exitcode=1 --std=c11 --enable=warning,portability --suppress=ctuuninitvar \
  '-DcJSON_ArrayForEach(item,array)=for(item=(array)->child;item;item=item->next)' \
  -Iinclude -Isim -Isrc $(find src sim tools -name '*.c' -not -path 'src/firmware/*') || fail "cppcheck"
# telemetry.c is all macros
cppcheck --quiet --error-exitcode=1 --std=c11 --enable=warning,portability -DGLUE=glue_static -Iinclude -Isim/crazyflie \
  $(find src/firmware -name '*.c' -not -name telemetry.c) || fail "cppcheck of the app"

for header in $(echo "$sources" | grep '\.h$'); do
  case $header in
  src/firmware/* | sim/crazyflie/* | test/pil/*) more="-Isim/crazyflie" ;;
  *) more= ;;
  esac
  gcc -std=c11 -Wall -Wextra -Wpedantic -Werror -Wno-psabi -fsyntax-only -Iinclude -Isrc -Isim -Itest $more -x c "$header" ||
    fail "$header does not compile alone"
done

# Flight code: single precision, no allocation, of libm only what is an instruction, no printing.
if grep -nE '\b(double|malloc|calloc|realloc|free|printf)\b' src/*.c include/flight/*.h | grep -vE '//.*\b(double|free)\b'; then
  fail "flight code has a double, an allocation or a print"
fi
b=${O:-out}/release
make -s O="${O:-out}" B="$b" $(for c in src/*.c; do echo "$b/${c%.c}.o"; done) || fail "flight code does not build"
calls=$(nm -u "$b"/src/*.o | sed -nE 's/^ +U (.*)/\1/p' | sort -u)
for call in $calls; do
  case $call in
  memcpy | memcmp | memset | strcmp) continue ;; # the firmware has these
  esac
  nm "$b"/src/*.o | grep -qE " [TRD] $call\$" || fail "flight code calls $call"
done

export PYTHONDONTWRITEBYTECODE=1
python3 tools/lint/arrows.py || fail "an include that points up the stack, or in a circle"
python3 tools/lint/rules.py || fail "the rules of the house"
python3 tools/lint/traps.py || fail "a trap of test/seeded that changes nothing"
said=$(python3 -m unittest discover -q -s test/doc 2>&1) || fail "the tests of tools/doc: $said"
said=$(python3 test/mutants/test_mutate.py 2>&1) || fail "the mutants: $said"
python3 tools/doc/doc.py check || fail "documents and recipes"
python3 tools/lint/links.py || fail "a page that leads nowhere"
[ $bad = 0 ] && echo "lint: clean"
exit $bad
