#!/bin/sh
# build.sh - what the build promises: other flags build anew, the same flags do not, and outputs do not affect each other.
set -eu
unset MAKEFLAGS MAKELEVEL MFLAGS
top=$(mktemp -d)
trap 'rm -rf "$top"' EXIT
bad=0
object=$top/release/src/rls.o

# expect WANTED WHAT MAKE-ARGUMENTS...: checks whether making the object again compiles it.
expect() {
  wanted=$1 what=$2
  shift 2
  before=$(stat -c %y "$object" 2>/dev/null || echo none)
  make O="$top" "$@" "$object" >"$top/log" 2>&1 || { cat "$top/log" >&2; exit 1; }
  [ "$before" = "$(stat -c %y "$object")" ] && got=kept || got=compiled
  [ $got = $wanted ] && return
  echo "build: $what: the object is $got, not $wanted" >&2
  bad=1
}

expect compiled "for the first time"
expect kept "nothing has changed"
expect compiled "without optimisation" OPT='-O0 -g'
expect kept "the same flags again" OPT='-O0 -g'
expect compiled "with coverage" OPT='-O0 -g' SANITIZE=--coverage
expect compiled "as it was at first"
[ $bad = 0 ] && echo "build: other flags build anew, the same ones do not"
exit $bad
