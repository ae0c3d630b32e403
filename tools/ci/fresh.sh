#!/bin/sh
# fresh.sh - what a new user meets: types the README's commands in a bare Debian 12 that has gcc, make and git.
#
# One root is bootstrapped from the mirror that this machine's apt uses, and copied. In one of them root types; in the
# other a user who may neither install nor write into the tree. Downloads are kept in O/fresh/archives. Skips, and says so,
# where this is not root, or debootstrap is missing.
set -eu
skip() {
  echo "fresh: skipped: $*"
  exit 0
}
[ "$(id -u)" = 0 ] || skip "only root can enter a root of its own"
command -v debootstrap >/dev/null || skip "no debootstrap"
suite=bookworm
# shellcheck disable=SC2016 # apt's own variables
mirror=$(apt-get indextargets --format '$(CODENAME) $(REPO_URI)' 'Created-By: Packages' | awk -v s=$suite '$1 == s { print $2; exit }')
[ -n "$mirror" ] || skip "this machine's apt knows no mirror of $suite"

mkdir -p "${O:-out}/fresh/archives/partial"
top=$(cd "${O:-out}/fresh" && pwd)
exec 8>"$top/lock"
flock -n 8 || { echo "fresh: another one runs in $top" >&2; exit 1; }
leave() {
  for mounted in "$top"/*/proc "$top"/*/var/cache/apt/archives; do
    ! mountpoint -q "$mounted" || umount -l "$mounted"
  done
}
remove() {
  leave
  rm -rf --one-file-system "$top/bare" "$top/root" "$top/user"
}
fail() {
  cat "$top"/root/tmp/tmp.* "$top"/user/tmp/tmp.* >>"$top/log" 2>/dev/null || true
  tail -15 "$top/log" >&2
  echo "fresh: $*; the whole log is $top/log" >&2
  exit 1
}
began=$(date +%s)
lasted() {
  now=$(date +%s)
  echo "fresh: $*, $((now - began)) s"
  began=$now
}

# within ROOT LINE: runs LINE in the root, with nothing of this machine but its proxy. Without its terminal, too, because
# apt in the background would stop at one.
within() {
  root=$top/$1
  mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
  mountpoint -q "$root/var/cache/apt/archives" || mount --bind "$top/archives" "$root/var/cache/apt/archives"
  setsid -w env -i HOME=/root TERM=dumb LC_ALL=C PATH=/usr/sbin:/usr/bin:/sbin:/bin ${http_proxy:+http_proxy="$http_proxy"} \
    ${https_proxy:+https_proxy="$https_proxy"} chroot "$root" sh -c "$2" </dev/null
}
as_user() { within user "su flyer -c 'cd /srv/flight && $1 O=/home/flyer/out'"; }
packages() { within "$1" 'dpkg-query -W' | sort; }

# again ROOT COMMAND...: checks that what was installed and compiled once is not a second time.
again() {
  machine=$1
  shift
  packages "$machine" >"$top/before"
  "$@" >"$top/log" 2>&1 || fail "the second demo fails"
  packages "$machine" | cmp -s "$top/before" - || fail "the second demo changes the packages"
  ! grep -E 'to be installed|compiling' "$top/log" || fail "the second demo installs or compiles"
}
passes() { grep -q '^[1-9][0-9]* passed, 0 failed$' "$top/log"; }

remove
trap remove EXIT
trap 'exit 1' HUP INT TERM
debootstrap --variant=minbase --cache-dir="$top/archives" $suite "$top/bare" "$mirror" >"$top/log" 2>&1 || fail "no bare root"
cp /etc/resolv.conf "$top/bare/etc/resolv.conf"
apt-config dump | grep '^Acquire::.*[Pp]roxy' >"$top/bare/etc/apt/apt.conf.d/90proxy" || true
# Its files need not survive a power cut.
echo force-unsafe-io >"$top/bare/etc/dpkg/dpkg.cfg.d/unsafe"
within bare 'apt-get update && apt-get install -y --no-install-recommends gcc make git' >"$top/log" 2>&1 || fail "no gcc, make and git"
leave
git clone -q --no-hardlinks . "$top/bare/srv/flight"
git -C "$top/bare/srv/flight" checkout -q --detach "$(git rev-parse HEAD)"
cp -a "$top/bare" "$top/user"
mv "$top/bare" "$top/root"
lasted "a bare root"

within root 'cd /srv/flight && make demo' >"$top/log" 2>&1 || fail "root's first demo fails"
grep -q '^with what they need [0-9]* packages' "$top/log" || fail "it is not said how much is installed"
[ "$(find "$top/root/srv/flight/out/demo" -name '*.png' | wc -l)" -ge 5 ] || fail "the demo drew no pictures"
lasted "root: the first make demo"
within root 'cd /srv/flight && make test' >"$top/log" 2>&1 && passes || fail "root's tests fail"
lasted "root: make test"
again root within root 'cd /srv/flight && make demo'
lasted "root: the second make demo installs and compiles nothing"
umount -l "$top/root/proc" "$top/root/var/cache/apt/archives"
rm -rf --one-file-system "$top/root"

# Each goal must print one line, the same for both, beside make's own; and that line must suffice.
within user 'useradd -m flyer'
for goal in demo test; do
  status=0
  as_user "make $goal" >"$top/log" 2>&1 || status=$?
  [ $status = 2 ] || fail "make $goal without root ends with $status, not 2"
  grep -v '^make: \*\*\*' "$top/log" >"$top/line.$goal" || true
done
cmp -s "$top/line.demo" "$top/line.test" && [ "$(wc -l <"$top/line.demo")" = 1 ] || fail "not one line, the same for demo and test"
touch "$top/began"
within user "$(cat "$top/line.demo")" >"$top/log" 2>&1 || fail "the line that is printed does not install: $(cat "$top/line.demo")"
lasted "a user: the line that is printed, typed"
as_user 'make test' >"$top/log" 2>&1 && passes || fail "the user's tests fail after that line"
lasted "a user: make test of a tree that is not the user's"
as_user 'make demo' >"$top/log" 2>&1 || fail "the user's demo fails"
again user as_user 'make demo'
lasted "a user: make demo, twice"
[ -z "$(find "$top/user/srv/flight" -newer "$top/began")" ] || fail "something was written into the tree: make O=DIR"
echo "fresh: passed"
