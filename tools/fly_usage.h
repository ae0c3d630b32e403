// fly_usage.h - the options of fly, and what fly --help says of them.
#ifndef FLY_USAGE_H
#define FLY_USAGE_H

#include <getopt.h>

// clang-format off
static const struct option OPTIONS[] = {
    {"controller", 1, 0, 'c'}, {"thesis-law", 0, 0, 'w'}, {"set", 1, 0, 's'},
    {"set-from", 1, 0, 'S'}, {"params-to", 1, 0, 'T'}, {"usd", 1, 0, 'u'},
    {"usd-config", 1, 0, 'U'}, {"replay", 1, 0, 'R'}, {"effect", 1, 0, 'e'},
    {"commands", 1, 0, 'C'}, {"scene", 1, 0, 'x'}, {"storage", 1, 0, 'X'}, {"vehicle", 1, 0, 'v'},
    {"noise", 1, 0, 'n'}, {"seed", 1, 0, 'd'}, {"seeds", 1, 0, 'm'}, {"integrator", 1, 0, 'i'},
    {"from", 1, 0, 'f'}, {"to", 1, 0, 't'}, {"log", 1, 0, 'l'}, {"log-rate", 1, 0, 'r'},
    {"json", 1, 0, 'j'}, {"list", 0, 0, 'L'}, {"effects", 0, 0, 'E'}, {"logs", 0, 0, 'G'},
    {"summary", 1, 0, 'M'}, {"merge", 0, 0, 'g'}, {"params", 2, 0, 'P'}, {"help", 0, 0, 'h'},
    {"version", 0, 0, 'V'}, {0},
};
// clang-format on

static const char USAGE[] =
    "usage: fly SCENARIO [options]\n"
    "       fly --merge FILE... [--summary FILE]\n"
    "       fly --commands FILE [--scene FILE.toml] [--storage FILE] [options]\n"
    "  --controller NAME        who flies; see --list\n"
    "  --thesis-law             the thesis's law and gains in place of those that ship\n"
    "  --set group.name=VALUE   a parameter of the flight code; see --params (may be repeated)\n"
    "  --set-from FILE          a file of such lines, group.name=VALUE\n"
    "  --effect NAME[:KEY=VALUE,...]  switches an effect of the plant on, or changes it; `none` first "
    "switches\n"
    "                           off what the scenario has; see --list (may be repeated)\n"
    "  --vehicle FILE           a vehicle file (sim/vehicle/vehicles/*.toml)\n"
    "  --noise LEVEL            none, n1, n2 or n3; in six degrees of freedom quiet, real, flown, or of "
    "these\n"
    "                           some numbers changed: real:acc.z=0.1,...; see --list\n"
    "  --seed N                 of the noise; the first one with --seeds (1)\n"
    "  --seeds N                flies N times, with seeds that count up (1)\n"
    "  --from A --to B          flies seeds A to B on all processors, a line each; --json then gets JSON "
    "lines\n"
    "  --summary FILE           with --from and --to: what they came to, in place of a line each; one line "
    "of "
    "JSON\n"
    "  --merge FILE...          in place of a scenario: joins summaries, as one run would have written them\n"
    "  --integrator NAME        sundials, rk4 or reference (sundials)\n"
    "  --log FILE.csv           writes the flight with Crazyflie log names (one seed only)\n"
    "  --log-rate HZ            100; in six degrees of freedom also 500, or 1000: every call of the app, for "
    "--replay\n"
    "  --params-to FILE         writes the parameters that were flown, for --set-from\n"
    "  --usd FILE               writes what the uSD deck on board would, with the config.txt of\n"
    "  --usd-config FILE        its card: tools/usd/config.txt\n"
    "  --replay FILE            in place of a scenario: that log's inputs through the flight code, and "
    "whether "
    "it\n"
    "                           commands what was logged\n"
    "  --commands FILE          in place of a scenario: what clients sent at the desk (desk --log DIR), "
    "flown "
    "anew;\n"
    "                           with the desk's options the same flight, to the bit\n"
    "  --scene FILE.toml        where, as for the desk\n"
    "  --storage FILE           what was stored before; it is not written\n"
    "  --json FILE              writes what is printed, and more\n"
    "  --list                   scenarios, controllers and effects\n"
    "  --effects                what each effect does, as a table in Markdown\n"
    "  --logs                   what the app logs, by group\n"
    "  --params                 the parameters of the flight code, with unit, default and range\n"
    "  --version                version and commit\n"
    "  --help                   this\n"
    "Exit status: 0; 2 if the input is bad; 1 if something else fails, or a flight did not stay finite (what "
    "it was\n"
    "like is written nevertheless).\n";

#endif
