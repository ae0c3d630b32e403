# The firmware's quaternion is x, y, z, w.
# file: src/firmware/units.c
# test: app_
s/(quat_t){q\.w, q\.x, q\.y, q\.z}/(quat_t){q.x, q.y, q.z, q.w}/
