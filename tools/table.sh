#!/bin/sh
# table.sh KIND FILE - writes the table of all effects, curves, scenarios, vehicles or tests of the tree, or a text as C.
#
# A new file, or a new TEST(), gets into the table without being listed anywhere. FILE is touched only when it changes.
set -eu
kind=$1 file=$2
mkdir -p "$(dirname "$file")"
new=$(mktemp)
trap 'rm -f "$new"' EXIT

# names KIND FOLDER: every `const KIND_t KIND_NAME` defined there, in one order on every machine.
names() {
  sed -nE "s/^const $1_t ($1_[a-z0-9_]+) = .*/\1/p" "$2"/*.c | LC_ALL=C sort
}

# of TYPE HEADER FOLDER: an array of pointers to every `const TYPE KIND_NAME` defined in FOLDER.
of() {
  names=$(names "$kind" "$3")
  echo "#include \"$2\""
  for name in $names; do echo "extern const $1 $name;"; done
  echo "const $1 *const ${kind}_table[] = {"
  for name in $names; do echo "    &$name,"; done
  echo "};"
  [ "$kind" != fx ] ||
    echo "_Static_assert(sizeof fx_table / sizeof *fx_table <= FX_MAX, \"FX_MAX holds every effect\");"
  echo "const int ${kind}_count = (int)(sizeof ${kind}_table / sizeof *${kind}_table);"
}

# The files of sim/vehicle/vehicles as C strings.
vehicles() {
  echo '#include "vehicle/model_file.h"'
  echo "const vehicle_text_t vehicle_table[] = {"
  for path in sim/vehicle/vehicles/*.toml; do
    echo "    {\"$(basename "$path" .toml)\","
    sed -E 's/\\/\\\\/g; s/"/\\"/g; s/.*/     "&\\n"/' "$path"
    echo "    },"
  done
  echo "};"
  echo "const int vehicle_count = (int)(sizeof vehicle_table / sizeof *vehicle_table);"
}

# The style of gap's page as a C string.
style() {
  echo "extern const char style_text[];"
  echo "const char style_text[] ="
  sed -E 's/\\/\\\\/g; s/"/\\"/g; s/.*/    "&\\n"/' sim/gap/8_report/page.css
  echo "    ;"
}

# A test whose name has other characters than small letters, digits and _ would compile and never run.
tests() {
  files=$(find test -name 'test_*.c' | LC_ALL=C sort)
  odd=$(grep -HnE '^[[:space:]]*TEST[[:space:]]*\(' $files | grep -vE ':TEST\([a-z0-9_]+\)' || true)
  if [ "$odd" ]; then
    echo "$odd" | sed -E 's/$/: never run; allowed: TEST(small_letters_digits_and_) at the beginning of a line/' >&2
    exit 1
  fi
  echo '#include "rig/test.h"'
  rows=$(grep -HoE '^TEST\([a-z0-9_]+\)' $files | sed -E 's/:TEST\((.*)\)/ \1/')
  echo "$rows" | while read -r _ name; do echo "TEST($name);"; done
  echo "const test_t test_table[] = {"
  echo "$rows" | while read -r path name; do
    echo "    {\"$(basename "$path")\", \"$name\", test_$name},"
  done
  echo "};"
  echo "const int test_count = (int)(sizeof test_table / sizeof *test_table);"
}

# The sources themselves, each in a namespace, with tables as above: for eight vehicles at a time.
lanes() {
  for path in sim/effects/curve_*.c sim/effects/fx_*.c; do
    echo "namespace in_$(basename "$path" .c) {"
    echo "#include \"effects/$(basename "$path")\""
    echo "}"
  done
  for kind in fx curve; do
    echo "const ${kind}_t *const ${kind}_in_lanes[] = {"
    for name in $(names $kind sim/effects); do
      echo "    &in_$(basename "$(grep -lE "^const ${kind}_t $name = " sim/effects/*.c)" .c)::$name,"
    done
    echo "};"
  done
}

case $kind in
fx) of fx_t effects/fx.h sim/effects ;;
curve) of curve_t effects/fx.h sim/effects ;;
scenario) of scenario_t flight/scenario.h sim/flight/scenario ;;
vehicle) vehicles ;;
style) style ;;
lanes) lanes ;;
test) tests ;;
*) echo "table.sh: unknown kind $kind" >&2; exit 2 ;;
esac >"$new"
cmp -s "$new" "$file" || cp "$new" "$file"
