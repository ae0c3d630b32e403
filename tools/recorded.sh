#!/bin/sh
# recorded.sh DATA - the workflow on the recorded flights of DATA, in short: what is named, with which numbers.
set -eu
data=${1:-}
if [ -z "$data" ]; then
  echo 'skipped: no measured data'
  exit
fi
o=${O:-out}
out=$o/recorded
mkdir -p $out

# gap with the files of the tree; logs are named from DATA on.
told() {
  vehicle=$1 columns=$2
  shift 2
  logs=
  for log; do logs="$logs $data/$log"; done
  echo "$vehicle.toml, $*"
  file=sim/vehicle/vehicles/$vehicle.toml
  [ -f "$file" ] || file=$out/$vehicle.toml
  # shellcheck disable=SC2086
  "$o/gap" --vehicle "$file" --columns tools/columns/"$columns".toml --json $out/verdict.json $logs >$out/said 2>&1 || [ $? -eq 2 ]
  awk '
    /^(gap:|Nothing|These|Something|unknown:)/ { sub(dir, ""); print "  " $0 }
    /^[a-z_]+: / && !/^(unknown|held out|note|gap):/ { name = $1; sub(":", "", name); getline; print "  " name $0 }
    /nearer than/ { sub(/.*held out, /, ""); print "  held out, " $0 }
    /^  force_z / { print "  force_z m/s2, held out: " $3 " -> " $4 }
    /^  would do as well/ { sub(/; to tell.*/, ""); print "   " $0 }' dir="$data/" $out/said | sed 's/  */ /g; s/^/ /'
  grep -oE '"([a-z_]+ is withdrawn|[a-z_]+ or [a-z_]+ is missing|[a-z_]+: [0-9.e-]+ [a-z0-9/]+ is left)[^"]*"' $out/verdict.json |
    sed 's/"//g; s/^/  /' || true
  echo
}

# The brushless vehicle that flew, 37 g; and a vehicle file that has neither lag nor drag.
sed 's/^\(mass_kg *= *\)[0-9.]*/\10.037/' sim/vehicle/vehicles/cf21_brushless.toml >$out/cf21_brushless_37g.toml
sed 's/^\(motor_tau_s *= *\)[0-9.]*/\10.001/' sim/vehicle/vehicles/cf21_imrc.toml >$out/cf21_imrc_without_lag.toml
ground=ground_effect/21_randomwalk_s_cf50
told cf21_neural_swarm neural_swarm ${ground}_00.csv ${ground}_02.csv ${ground}_04.csv
told cf21_imrc_without_lag imrc imu_rpm_500hz/jana00.csv imu_rpm_500hz/jana03.csv imu_rpm_500hz/jana05.csv imu_rpm_500hz/jana10.csv
told cf21_imrc imrc imu_rpm_500hz/jana00.csv imu_rpm_500hz/jana03.csv imu_rpm_500hz/jana05.csv imu_rpm_500hz/jana10.csv
told cf21_brushless_37g imrc brushless/flight00.csv brushless/flight12.csv brushless/flight22.csv
told cf21_nanobench nanobench nanobench/B2_circle_slow_rep1.csv nanobench/B5_helix_fast_rep1.csv
told quad15 quad15 quad15/hovering.csv
told cf_inner_loop_id inner_loop_id inner_loop_id/data_1901.csv
told cf21_static_imu static_imu static_imu/estAcceleration.csv
told cf21_air_garage air_garage ceiling_gap/20240822_21_32_29.csv ceiling_gap/20240822_21_35_34.csv
