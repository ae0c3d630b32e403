#!/bin/sh
# setup.sh PACKAGE... - installs the Debian packages that are missing, or prints the one line that does.
export LC_ALL=C

# Two that run at once would fight for apt's lock: the second waits, and then finds everything installed.
o=${O:-out}
mkdir -p "$o" || exit 2
exec 9>"$o/setup.lock"
flock 9

missing=
for package in "$@"; do
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)
  [ "$status" = "install ok installed" ] || missing="$missing $package"
done
[ -z "$missing" ] && exit 0

install="apt-get install -y --no-install-recommends"
if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=sudo
else
  # A bare Debian has no sudo.
  command -v sudo >/dev/null && become='sudo sh' || become=su
  echo "$become -c 'apt-get update && $install$missing'" >&2
  exit 2
fi

log=$(mktemp) status=$(mktemp)
failed() {
  rm -f "$status"
  tail -5 "$log" >&2
  echo "could not install$missing; the whole log is in $log" >&2
  exit 1
}

# Prints every tenth per cent of apt's progress; each per cent where a person looks on.
[ -t 2 ] && step=1 || step=10
progress() {
  told=0
  while IFS= read -r line; do
    percent=${line#*:*:}
    case $line in
    dlstatus:*) part=$((${percent%%[.:]*} / 2)) ;;
    pmstatus:*) part=$((50 + ${percent%%[.:]*} / 2)) ;;
    *) continue ;;
    esac
    [ $part -ge $((told + step)) ] || continue
    told=$((part - part % step))
    [ $step = 1 ] && printf '\r  installing: %d %% ' $told >&2 || echo "  installing: $told %" >&2
  done
  [ $step != 1 ] || printf '\r%30s\r' '' >&2
}

echo "to be installed:$missing"
$as_root apt-get update >"$log" 2>&1 || failed
$as_root apt-get install --assume-no --no-install-recommends $missing 2>/dev/null |
  sed -nE 's/.* ([0-9]+) newly installed.*/with what they need \1 packages:/p; s/^Need to get (.*) of archives.*/\1 to fetch,/p
    s/^After this operation, (.*) of additional.*/\1 on disk; some minutes/p' | xargs -r
# apt closes its progress descriptor for the packages' own scripts, so that it must not be one that they print to; and sudo
# closes all but the first three, so that it is opened inside sudo.
{
  $as_root sh -c "DEBIAN_FRONTEND=noninteractive exec $install -o Dpkg::Use-Pty=0 -o APT::Status-Fd=3 $missing 3>&1 >&2" 2>>"$log"
  echo $? >"$status"
} | progress
[ "$(cat "$status")" = 0 ] || failed
rm -f "$log" "$status"
