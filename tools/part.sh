# part.sh - for docs.sh and report.sh (. tools/part.sh).

# part NAME: replaces what stands in README.md between `<!-- NAME -->` and `<!-- end -->` by standard input.
part() {
  new=$(mktemp)
  awk -v start="<!-- $1 -->" -v body="$(cat)" '
    $0 == start { print; print body; skip = 1; found = 1; next }
    $0 == "<!-- end -->" { skip = 0 }
    !skip { print }
    END { exit !found }' README.md >"$new" || { echo "README.md has no part $1" >&2; exit 1; }
  cat "$new" >README.md
  rm -f "$new"
}

text() { echo '```'; cat; echo '```'; }
