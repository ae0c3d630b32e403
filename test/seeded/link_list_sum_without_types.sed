# Clients go by the list of another build.
# file: sim/link/link_list.c
# test: test_link
s/add(add(add(crc, &type, 1), row.group/add(add(crc + 0u * type, row.group/;s/row.name, strlen(row.name) + 1);/row.name, strlen(row.name) + 1);/
