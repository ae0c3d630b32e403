# flights.awk - JSON lines of out/fly, one file for each controller, as a table: a row for each controller and distance.
# Keys may stand in any order; a segment holds no braces.

# The number of that key in s. Every flight has it: else the table would be wrong.
function of(s, key) {
  if (match(s, "\"" key "\":-?[0-9][^,}]*")) return substr(s, RSTART + length(key) + 3, RLENGTH - length(key) - 3) + 0
  printf "flights.awk: %s:%d: no number %s\n", FILENAME, FNR, key >"/dev/stderr"
  failed = 1
  exit 1
}

function row(who, k,   n, mean, spread, gap) {
  n = flights[who]
  mean = error[who, k] / n
  spread = error2[who, k] / n - mean * mean # of the flights' means
  spread = sqrt((spread > 0 ? spread : 0) + sd2[who, k] / n)
  gap = distance[k] - mean
  printf "%-13s %4.0f %5.2f  %6.1f %5.2f  %6.1f %5.2f  %6.1f  %6.1f  %5d %5d/%d  %6.1f %5.2f  %5.1f\n", who, distance[k],
    distance[k] / radius_mm, gap, gap / radius_mm, spread, spread / radius_mm, mean, sqrt(sd2[who, k] / n),
    contacts[who, k], hit[who, k], n, low[who, k], low[who, k] / radius_mm, tilt[who, k]
}

FNR == 1 {
  who = FILENAME
  sub(/^[^.]*\./, "", who)
  sub(/\.jsonl$/, "", who)
  order[++controllers] = who
}

# What the flight code flew with, as fly prints it.
FNR == 1 && match($0, /"set":\{[^}]*\}/) {
  but = substr($0, RSTART + 7, RLENGTH - 8)
  gsub(/"/, "", but)
  gsub(/:/, "=", but)
  gsub(/,/, " --set ", but)
  but = "indi*: parameters as shipped" (but == "" ? "" : ", but for --set " but)
  if (said != "" && said != but) { print "flights.awk: not all with the same parameters" >"/dev/stderr"; failed = 1; exit 1 }
  said = but
}

{
  flights[who]++
  ceiling_mm = 1e3 * of($0, "ceiling_m")
  radius_mm = 1e3 * of($0, "rotor_radius_m")
  segments = $0
  sub(/.*"segments":\[/, "", segments)
  sub(/\].*/, "", segments)
  n = split(segments, part, "}") - 1
  if (n > steps) steps = n
  for (k = 1; k <= n; k++) {
    s = part[k]
    distance[k] = ceiling_mm - 1e3 * of(s, "setpoint_m")
    e = of(s, "mean_error_mm")
    error[who, k] += e
    error2[who, k] += e * e
    sd2[who, k] += of(s, "sd_mm") ^ 2
    contacts[who, k] += of(s, "contacts")
    hit[who, k] += of(s, "contacts") > 0
    if (of(s, "contacts") == 0) calm[who, k] += of(s, "sd_mm")
    gap = of(s, "min_gap_mm")
    if (!((who, k) in low) || gap < low[who, k]) low[who, k] = gap
    lean = of(s, "tilt_max_deg")
    if (lean > tilt[who, k]) tilt[who, k] = lean
  }
}

# Mean of the standard deviations of the flights that did not touch there, and that of the first controller's.
function free_sd(k,   i, n, mean, first) {
  printf "\n%.0f mm, flights that did not touch there: mean of their sd, and its ratio to the first\n", distance[k]
  for (i = 1; i <= controllers; i++) {
    n = flights[order[i]] - hit[order[i], k]
    if (n == 0) { printf "%-13s  none\n", order[i]; continue }
    mean = calm[order[i], k] / n
    if (i == 1) first = mean
    printf "%-13s %6.2f mm  %5s  of %d\n", order[i], mean, (first > 0 ? sprintf("%.2f", mean / first) : "-"), n
  }
}

END {
  if (failed) exit 1
  if (said != "") print said
  printf "R = %.2f mm\n", radius_mm
  printf "%-13s %10s  %12s  %12s  %6s  %6s  %5s %8s  %12s  %5s\n", "", "commanded", "mean", "sd", "error", "oscil.",
    "con-", "flights", "smallest gap", "tilt"
  printf "%-13s %4s %5s  %6s %5s  %6s %5s  %6s  %6s  %5s %8s  %6s %5s  %5s\n", "controller", "mm", "R", "mm", "R", "mm",
    "R", "mm", "mm", "tacts", "touching", "mm", "R", "deg"
  for (k = 2; k <= steps; k++) # the first is the hover far away
    for (i = 1; i <= controllers; i++) row(order[i], k)
  if (sd_of_free) free_sd(steps)
}
