#!/usr/bin/awk -f
# long_functions.awk FILE... - lists functions over 40 lines; exit status 1 if there is one.
FNR == 1 { open = 0 }
/^(TEST[(]|[a-z]).*[)] [{]$/ || /^    .*[)] [{]$/ && head { open = FNR; name = $0 }
{ head = /^[a-z][^;]*[,(]$/ }
/^}$/ && open {
  if (FNR - open + 1 > 40) { print FILENAME ":" open ": " FNR - open + 1 " lines: " name; long = 1 }
  open = 0
}
END { exit long }
