// desk_usage.h - what desk --help says.
#ifndef DESK_USAGE_H
#define DESK_USAGE_H

static const char USAGE[] =
    "usage: desk [SCENE.toml] [options]    a simulated Crazyflie with this app, for the stock client and "
    "library\n"
    "  --vehicle FILE           a vehicle file (sim/vehicle/vehicles/*.toml)\n"
    "  --effect NAME[:KEY=VALUE,...]  as fly takes it (may be repeated)\n"
    "  --noise LEVEL            quiet, real or flown, or of these some numbers changed (real)\n"
    "  --seed N                 of the noise (1)\n"
    "  --drones N               so many, on ports that follow each other (1 to 10)\n"
    "  --port N                 of the first (19850: what the client scans)\n"
    "  --address A              listens there (127.0.0.1: this machine alone; 0.0.0.0: at every address of "
    "it)\n"
    "  --page PORT              where a browser sees it (8080; 0: nowhere)\n"
    "  --speed X                times real time (1)\n"
    "  --link KEY=VALUE,...     loss=SHARE,delay=SECONDS of the packets (0)\n"
    "  --storage FILE           keeps the parameters that a client stores (forgotten at the end)\n"
    "  --log DIR                writes each flight (N.csv, N: 0, 1, ...), what came over the link "
    "(N.commands: how "
    "fly\n"
    "                           flies it anew stands in it), and what was stored before (N.storage)\n"
    "  --for SECONDS            ends by itself after so much simulated time\n"
    "  --version, --help\n"
    "Ctrl-C, SIGTERM or SIGHUP ends it; what was logged is whole. Exit status: 0; 2 if the input is bad; 1 "
    "if something "
    "fails.\n";

#endif
