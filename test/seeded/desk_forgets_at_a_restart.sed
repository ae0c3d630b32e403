# A restart begins with no stored parameter.
# file: sim/drone/drone.c
# test: test_flown_anew
s/storage_restore(&d->storage, f);/(void)0;/
