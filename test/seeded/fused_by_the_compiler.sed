# The firmware's build is allowed to fuse.
# file: src/firmware/Kbuild
# test: objects
s/ccflags-y += -ffp-contract=off/ccflags-y +=/
