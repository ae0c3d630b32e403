# typed.sh - for scripts whose output stands in a README.md (. tools/typed.sh): what is shown is what is typed.

# typed LINE: shows the line of the shell, and runs it.
typed() {
  printf '$ %s\n' "$1"
  eval "$1"
}
