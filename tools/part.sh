# part.sh - for docs.sh and report.sh (. tools/part.sh).

# part NAME: replaces what stands in the README.md that has it between `<!-- NAME -->` and `<!-- end -->` by standard input.
part() {
  readme=$(grep -rlxF --include=README.md -e "<!-- $1 -->" README.md src sim test) || { echo "no README.md has a part $1" >&2; exit 1; }
  new=$(mktemp)
  awk -v start="<!-- $1 -->" -v body="$(cat)" '
    $0 == start { print; print body; skip = 1; next }
    $0 == "<!-- end -->" { skip = 0 }
    !skip { print }' "$readme" >"$new"
  cat "$new" >"$readme"
  rm -f "$new"
}

text() { echo '```'; cat; echo '```'; }
