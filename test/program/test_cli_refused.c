// test_cli_refused.c - what the programs refuse, and how.
#include "rig/programs.h"
#include "rig/test.h"

#define HAND_HELD                                                                                            \
  "fly: --controller, --set, --effect, --integrator, --log-rate: in hand-held nobody flies; allowed are "    \
  "--vehicle, --noise, --seed\n"

static const struct {
  const char *arguments, *line;
} REFUSED[] = {
    {"fly", "fly: one scenario is needed; fly --list shows them\n"},
    {"fly loop-the-loop", "fly: loop-the-loop: no such scenario; fly --list shows them\n"},
    {"fly appendix-a appendix-a", "fly: one scenario is needed; fly --list shows them\n"},
    {"fly appendix-a --wings",
     "fly: --wings: not an option; allowed: --controller, --thesis-law, --set, --set-from, --params-to, "
     "--usd, "
     "--usd-config, --replay, "
     "--effect, --commands, --scene, --storage, --vehicle, --noise, --seed, --seeds, --integrator, --from, "
     "--to, --log, --log-rate, --json, "
     "--list, --effects, --logs, --summary, --merge, --params, --help, --version\n"},
    {"fly close-flight --summary $S/x", "fly: --summary: allowed with --from and --to, or --merge\n"},
    {"fly --replay README.md --summary $S/x", "fly: --summary: nothing is flown by --replay; leave it out\n"},
    {"fly --merge", "fly: --merge: files are needed, as fly --summary writes them\n"},
    {"fly --merge --seed 3 README.md", "fly: --merge: allowed with it is --summary\n"},
    {"fly --merge README.md", "fly: README.md:1: no summary; allowed is what fly --summary wrote\n"},
    {"echo >$S/none; fly --merge $S/none", "fly: none:1: no summary; allowed is what fly --summary wrote\n"},
    {"fly --merge no/such", "fly: no/such: cannot be opened: No such file or directory\n"},
    {"cp README.md $S/both; fly --merge $S/both --summary $S/both",
     "fly: both: to be read and to be written; allowed: one of them\n"},
    {"fly test-flight --scene README.md", "fly: --scene, --storage: allowed with --commands FILE\n"},
    {"fly test-flight --commands README.md",
     "fly: --commands: no scenario is flown; leave out test-flight\n"},
    {"fly --commands README.md --seeds 3",
     "fly: --commands: allowed with it are --scene, --storage, --vehicle, --effect, --noise, --seed and "
     "--log\n"},
    {"fly --commands README.md", "fly: README.md:2: allowed is `MS HEX`, or `MS`, in the order of time\n"},
    {"cp README.md $S/both; fly --commands $S/both --log $S/both", // the tree may be another user's
     "fly: both: to be read and to be written; allowed: one of them\n"},
    {"fly appendix-a --seed", "fly: --seed: its value is missing; allowed: --seed VALUE\n"},
    {"fly --help=3", "fly: --help: takes no value; allowed: --help\n"},
    {"fly close-fligth",
     "fly: close-fligth: no such scenario (did you mean close-flight?); fly --list shows them\n"},
    {"fly appendix-a --controller indi-rfb",
     "fly: --controller indi-rfb (did you mean indi-rbf?): allowed are indi, indi-theory, indi-rbf, "
     "indi-learned; on the vertical axis pid, pid-ff; in six degrees of freedom stock-pid, stock-indi, "
     "air-garage\n"},
    {"fly appendix-a --set indipos.kp=1",
     "fly: --set indipos.kp: no such parameter (did you mean indiPos.kp?); fly --params lists them\n"},
    {"fly appendix-a --integrator sundial",
     "fly: --integrator sundial (did you mean sundials?): allowed are sundials, rk4, reference\n"},
    {"fly close-flight --noise reel",
     "fly: --noise reel (did you mean real?): allowed are none, n1, n2, n3 on the vertical axis, quiet, "
     "real, flown in six degrees of freedom\n"},
    {"fly appendix-a --vehicle sim/vehicle/vehicles/cf21_legcay.toml",
     "fly: sim/vehicle/vehicles/cf21_legcay.toml: cannot be opened: No such file or directory (did you mean "
     "sim/vehicle/vehicles/cf21_legacy.toml?)\n"},
    {"fly appendix-a --vehicle cf21_plus", "fly: cf21_plus: cannot be opened: No such file or directory (did "
                                           "you mean sim/vehicle/vehicles/cf21_plus.toml?)\n"},
    {"fly appendix-a --seed -3", "fly: --seed -3: allowed is a whole number from 0 to 1000000000\n"},
    {"fly appendix-a --seeds 0", "fly: --seeds 0: allowed is a whole number from 1 to 10000\n"},
    {"fly appendix-a --controller lqr",
     "fly: --controller lqr: allowed are indi, indi-theory, indi-rbf, indi-learned; on the vertical axis "
     "pid, "
     "pid-ff; in six degrees of freedom stock-pid, stock-indi, air-garage\n"},
    {"fly appendix-a --set indiPos.kp", "fly: --set indiPos.kp: allowed is group.name=value\n"},
    {"fly appendix-a --set indiPos.kq=1",
     "fly: --set indiPos.kq: no such parameter (did you mean indiPos.kp?); fly --params lists them\n"},
    {"fly appendix-a --set indiPos.kp=-1", "fly: --set indiPos.kp=-1: allowed is a number from 0.05 to 20\n"},
    {"fly appendix-a --set indiPos.kp=nan",
     "fly: --set indiPos.kp=nan: allowed is a number from 0.05 to 20\n"},
    {"fly appendix-a --set indiPos.kp=1x", "fly: --set indiPos.kp=1x: allowed is a number from 0.05 to 20\n"},
    {"fly appendix-a --set ceil.mode=1.5",
     "fly: --set ceil.mode=1.5: allowed is a whole number from 0 to 3\n"},
    {"fly appendix-a --set rls.q=1e-3 --set rls.p0=1e-3 --set rls.q=1e-3 --set ceil.near=0.2 --set "
     "ceil.floor=0.2 "
     "--set ceil.near=0.1",
     "fly: --set: with rls.q=0.001, rls.p0=0.001, ceil.floor=0.2, ceil.near=0.1, ceil.far=0.5, "
     "rls.zMin=0.005, "
     "rls.zMax=0.1: allowed is rls.q <= rls.p0, ceil.floor <= ceil.near < ceil.far, rls.zMin < rls.zMax\n"},
    {"fly appendix-a --set indiPos.cutoff=0.001",
     "fly: --set indiPos.cutoff=0.001: allowed is 0, or 0.1 to 45 Hz\n"},
    {"fly test-flight --set indiAtt.cutoff=0.1",
     "fly: --set indiAtt.cutoff=0.1: allowed is 0, or 0.5 to 200 Hz\n"},
    {"fly pid-tables --set indiPos.kp=1", "fly: --set: the flight code does not fly in pid-tables\n"},
    {"fly rls-sweep --controller pid", "fly: --controller pid: knows no ceiling distance to learn from\n"},
    {"fly appendix-a --noise loud",
     "fly: --noise loud: allowed are none, n1, n2, n3 on the vertical axis, quiet, real, flown in six "
     "degrees of freedom\n"},
    {"fly appendix-a --noise real",
     "fly: --noise real: this scenario is flown on the vertical axis; allowed are none, n1, n2, n3\n"},
    {"fly close-flight --noise real:acc.z=-1",
     "fly: --noise acc.z=-1: allowed is KEY=VALUE, keys and ranges as fly --list shows them\n"},
    {"fly close-flight --noise real:acc.w=1", "fly: --noise acc.w=1 (did you mean acc.z?): allowed is "
                                              "KEY=VALUE, keys and ranges as fly --list shows them\n"},
    {"fly close-flight --noise n1",
     "fly: --noise n1: this scenario is flown in six degrees of freedom; allowed are quiet, real, flown\n"},
    {"fly close-flight --noise flow",
     "fly: --noise flow (did you mean flown?): allowed are none, n1, n2, n3 on "
     "the vertical axis, quiet, real, flown in six degrees of freedom\n"},
    {"fly close-flight --noise flown:vary.mass=0.6",
     "fly: --noise vary.mass=0.6: allowed is KEY=VALUE, keys and ranges as fly --list shows them\n"},
    {"fly close-flight --noise flown:vary.mas=0.1", "fly: --noise vary.mas=0.1 (did you mean vary.mass?): "
                                                    "allowed is KEY=VALUE, keys and ranges as fly --list "
                                                    "shows them\n"},
    {"fly close-flight --noise flown:vary.gust.min=0.2",
     "fly: --noise vary.gust.min=0.2, vary.gust.max=0.15: allowed is min <= max\n"},
    {"fly appendix-a --noise flown",
     "fly: --noise flown: this scenario is flown on the vertical axis; allowed are none, n1, n2, n3\n"},
    {"fly appendix-a --integrator euler", "fly: --integrator euler: allowed are sundials, rk4, reference\n"},
    {"fly appendix-a --seeds 2 --log x.csv", "fly: --log: one flight can be written; leave out --seeds\n"},
    {"fly close-flight --from 1", "fly: --from, --to: both are needed, and --from <= --to\n"},
    {"fly close-flight --from 2 --to 1", "fly: --from, --to: both are needed, and --from <= --to\n"},
    {"fly close-flight --from 1 --to 2 --seeds 3",
     "fly: --seeds: allowed is either that or --from and --to\n"},
    {"fly close-flight --from 1 --to 2 --log x.csv",
     "fly: --log: one flight can be written; leave out --from and --to\n"},
    {"fly close-flight --from 1 --to 2 --json /no/such/dir/x.json",
     "fly: /no/such/dir/x.json: cannot be written: No such file or directory\n"},
    {"fly close-flight --from 1 --to 2 --seed 7", "fly: --seed: allowed is either that or --from and --to\n"},
    {"fly close-flight --log x.csv --log-rate 200", "fly: --log-rate 200: allowed are 100, 500, 1000\n"},
    {"fly close-flight --log-rate 500", "fly: --log-rate: allowed with --log FILE.csv\n"},
    {"fly appendix-a --log $S/x.csv --log-rate 500",
     "fly: --log-rate 500: this scenario is flown on the vertical axis; allowed is 100\n"},
    {"fly --params=html", "fly: --params=html: allowed is --params, or --params=markdown\n"},
    {"fly close-flight --vehicle sim/vehicle/vehicles/thesis_1d.toml",
     "fly: --vehicle: thesis 1-D has no [body] and [rotors]; in six degrees of freedom both are "
     "needed\n"},
    {"fly close-flight --effect mass:add=-1",
     "fly: effect mass: add = -1 kg to a vehicle of 0.0329 kg; allowed: -0.0296 or more\n"},
    {"fly close-flight --effect motor_damage:rotor=2.5",
     "fly: effect motor_damage: rotor = 2.5; allowed: whole numbers from 1 to 4\n"},
    {"fly close-flight --controller stock-pid --thesis-law",
     "fly: --thesis-law: stock-pid flies; allowed with indi*\n"},
    {"fly appendix-a --thesis-law",
     "fly: --thesis-law: this scenario is flown on the vertical axis, by that law or a PID\n"},
    {"fly close-flight --controller stock-pid --set indiPos.kp=2",
     "fly: --set: those are parameters of the flight code, and stock-pid flies; allowed with indi*\n"},
    {"fly ceiling-gap --set indiPos.kp=2",
     "fly: --set: those are parameters of the flight code, and stock-pid flies; allowed with indi*\n"},
    {"fly appendix-a --controller pid --set indiPos.kp=2",
     "fly: --set: those are parameters of the flight code, and pid flies; allowed with indi*\n"},
    {"fly close-flight --controller stock-indi --vehicle sim/vehicle/vehicles/cf21_brushless.toml",
     "fly: --controller stock-indi: knows the thrust maps of cf21_legacy and cf21_plus alone, and not that "
     "of "
     "Crazyflie 2.1 brushless\n"},
    {"fly learning-flight --controller stock-pid",
     "fly: --controller, --set ceil.mode: nothing learns then; allowed in learning-flight are neither, and "
     "ceil.mode=2\n"},
    {"fly hand-held --controller indi", HAND_HELD},
    {"fly hand-held --set ceil.gain=0.2", HAND_HELD},
    {"fly hand-held --effect wind", HAND_HELD},
    {"fly hand-held --effect none", HAND_HELD},
    {"fly hand-held --integrator rk4", HAND_HELD},
    {"fly appendix-a --json /no/such/dir/x.json",
     "fly: /no/such/dir/x.json: cannot be written: No such file or directory\n"},
    {"fly appendix-a --vehicle /no/such.toml",
     "fly: /no/such.toml: cannot be opened: No such file or directory\n"},
    {"fly pid-tables --controller indi", "fly: --controller: pid-tables flies pid and pid-ff\n"},
    {"effectiveness", "effectiveness: one log is needed; allowed: effectiveness LOG.csv\n"},
    {"effectiveness a.csv b.csv", "effectiveness: one log is needed; allowed: effectiveness LOG.csv\n"},
    {"effectiveness a.csv --lag 0", "effectiveness: --lag 0: allowed is a number from 0.001 to 0.5\n"},
    {"effectiveness a.csv --poles 3", "effectiveness: --poles 3: allowed are 2, 4\n"},
    {"effectiveness a.csv --wings",
     "effectiveness: --wings: not an option; allowed: --lag, --delay, --cutoff, "
     "--poles, --thrust-min, --motor-max, --as-stock, --json, --help, --version\n"},
    {"learn a.csv --veihcle x",
     "learn: --veihcle: not an option (did you mean --vehicle?); allowed: --columns, --vehicle, --surface, "
     "--hold-out, --set, --json, --points, --help, --version\n"},
    {"effectiveness /no/such.csv",
     "effectiveness: /no/such.csv: cannot be opened: No such file or directory\n"},
    {"bound 0.5", "bound: a gap, 0.5: allowed is a number from 1 to 1000\n"},
    {"bound --noise n1",
     "bound: --noise n1: this scenario is flown in six degrees of freedom; allowed are quiet, real, flown\n"},
    {"bound --walk -1", "bound: --walk -1: allowed is a number from 0 to 10\n"},
    {"bound --vehicle sim/vehicle/vehicles/thesis_1d.toml",
     "bound: --vehicle: thesis 1-D has no [body] and [rotors]; in six degrees of freedom both are "
     "needed\n"},
};

TEST(fly_refuses_bad_input_with_one_line_and_status_two) {
  for (unsigned i = 0; i < sizeof REFUSED / sizeof *REFUSED; i++) {
    ROW("%s", REFUSED[i].arguments);
    char text[2000];
    CHECK(program_run(REFUSED[i].arguments, STREAM_ERROR, text, sizeof text) == 2);
    CHECK_TEXT(text, REFUSED[i].line);
    CHECK(program_run(REFUSED[i].arguments, STREAM_OUTPUT, text, sizeof text) == 2);
    CHECK_TEXT(text, "");
  }
}
