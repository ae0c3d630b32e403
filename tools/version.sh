#!/bin/sh
# version.sh [FILE] - version and commit of this tree: to standard output, or as C to FILE, which is touched only when it
# changes.
#
# The version is the first one in .doc/CHANGELOG.md. The commit is git's, with a + if files differ from it; in an archive
# that git made, what git wrote into .doc/commit. Nothing else goes in, so that the same tree gives the same bytes.
set -eu
file=${1:-}
version=$(sed -nE 's/^## ([0-9][0-9.]*).*/\1/p' .doc/CHANGELOG.md 2>/dev/null | head -n 1)
commit=
export GIT_OPTIONAL_LOCKS=0
# A copy inside another repository does not take that repository's commit.
if [ "$(git rev-parse --show-toplevel 2>/dev/null)" = "$(pwd -P)" ]; then
  commit=$(git rev-parse --short=12 HEAD 2>/dev/null) || commit=
  [ -z "$commit" ] || [ -z "$(git status --porcelain --untracked-files=no 2>/dev/null)" ] || commit="$commit+"
fi
[ "$commit" ] || commit=$(grep -E '^[0-9a-f]{7,40}$' .doc/commit 2>/dev/null) || commit=
text="${version:-0} (commit ${commit:-not known})"
[ "$file" ] || { echo "$text"; exit; }
mkdir -p "$(dirname "$file")"
new=$(mktemp)
trap 'rm -f "$new"' EXIT
{
  echo '#include "base/version.h"'
  echo "const char version_text[] = \"$text\";"
} >"$new"
cmp -s "$new" "$file" || cp "$new" "$file"
