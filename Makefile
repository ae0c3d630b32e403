# Flight close to ceilings: flight code, simulator, tests. `make` alone says what there is.

CC  = gcc
CXX = g++
# All that is made goes there. It may be any folder, and the tree may be read-only: make O=DIR.
O   = out
export O
# Where objects go; one folder for each kind of build.
B   = $(O)/release
OPT = -O3

# What demo and test need, so that there is one list to install, once.
PACKAGES      = g++ libsundials-dev libeigen3-dev libtomlplusplus-dev libcsv-dev libcjson-dev libboost-math-dev libboost-context-dev libnlopt-dev zlib1g-dev libmicrohttpd-dev gnuplot-nox python3
# What some goals need besides.
LINT_PACKAGES = clang clang-format libclang-rt-14-dev cppcheck
LINT_GOALS    = lint arrows pictures format clang fuzz check mutants coverage setup-lint
PIL_PACKAGES  = gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
CF_PACKAGES   = python3-venv
DESK_PACKAGES = python3-venv chromium

WARN  = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion -Werror
C     = $(CC) -std=c11 $(OPT) $(MOVES) $(FAST) -fno-math-errno $(WARN) -Wno-psabi $(SANITIZE) -MMD -MP
CPP   = $(CXX) -std=c++17 $(OPT) $(MOVES) $(WARN) $(SANITIZE) -MMD -MP -isystem /usr/include/eigen3
# -Wno-psabi: vectors of four doubles (base/few.h) are passed inside of a program alone, whose objects agree.
# The same bits on host and target: no fused multiply-add.
FLIGHT_FLAGS = -ffp-contract=off
# What is compiled for AVX2 copies a struct by whole registers. By the 16 bytes that gcc 12 takes otherwise, a register
# that is read back waits until both halves are in memory: eight flights in lanes lose an eighth.
MOVES := $(if $(findstring clang,$(CC)),,$(if $(filter x86_64,$(shell uname -m)),-mmove-max=256 -mstore-max=256))
# Some files fly many vehicles at once. clang's OpenMP is another package: built by it, they fly one by one.
ifeq ($(findstring clang,$(CC)),)
OMP     = -fopenmp
OMP_LIB = -lgomp
else
OMP     = -Wno-unknown-pragmas -Wno-source-uses-openmp
endif
LIBS  = $(OMP_LIB) -lsundials_arkode -lsundials_nvecserial -lnlopt -lboost_context -ltomlplusplus -lcsv -lz -lcjson -lstdc++ -lm
DESK_LIBS = -lmicrohttpd

# Every source of some folders.
sources    = $(sort $(shell find $(1) -name '*.c' -o -name '*.cpp' 2>/dev/null))
EXAM_SRC  := $(filter-out test/exam/test_%,$(call sources,test/exam))
TEST_SRC  := $(filter-out test/exam/main.c test/exam/users_main.c,$(call sources,test/rig test/unit test/program test/faults test/exam))
# What serves people while it flies, and nobody else: apart, so that no other program loads a server's libraries.
DESK_SRC  := $(call sources,sim/desk)
SIM_SRC   := $(filter-out $(DESK_SRC),$(call sources,src sim))
objects    = $(patsubst %,$(B)/%.o,$(basename $(1)))
TABLES     = $(patsubst %,$(B)/gen/%_table.o,fx curve scenario vehicle style) $(B)/gen/version.o
SIM_OBJ    = $(call objects,$(SIM_SRC)) $(TABLES) $(LANES_OBJ)
# What is compiled a second time, for eight vehicles at a time (sim/base/lane_c.hpp): flight code, sensors, estimator.
LANES_SRC := $(filter-out src/params.c,$(wildcard src/*.c)) $(addprefix src/firmware/,battery_cap.c controller.c range_up.c recorder.c settings.c units.c) \
  $(addprefix sim/,crazyflie/crazyflie_ms.c crazyflie/stand_in_vehicle.c crazyflie/stock_units.c crazyflie/supervised.c flight/senses.c base/lowpass.c \
    plant/rotor.c plant/thrust_map.c sense/ekf.c sense/ekf_core.c sense/imu.c sense/range.c)
LANES_H   := $(filter-out sim/base/lane%,$(shell find include src sim -name '*.h'))
ifeq ($(shell uname -m),x86_64)
LANES_OBJ  = $(foreach bits,lanes lanes_512,$(patsubst %.c,$(B)/$(bits)/%.o,$(LANES_SRC)))
endif
LANES_OBJ += $(B)/lanes/fields.o $(B)/sim/body/lanes_512.o $(B)/sim/flight/lanes_ms_512.o
DESK_OBJ   = $(call objects,$(DESK_SRC)) $(B)/gen/page.o
PROGRAMS   = fly learn effectiveness gap slot bench bound desk
# What the tests run.
TESTED     = tests fly gap learn effectiveness bound

ifeq ($(MAKELEVEL),0)
MAKEFLAGS += -j$(shell nproc)
endif
MAKEFLAGS += --no-print-directory
ifneq ($(DATA),)
ifneq ($(shell test -d "$(DATA)" && echo there),there)
$(error DATA=$(DATA): no such folder; allowed is a folder of recorded flights, or no DATA)
endif
endif
.DELETE_ON_ERROR:
.SECONDARY:

help:  ## what can be made
	@echo '  make out/fly          flies scenarios (out/fly --help)'
	@echo '  make out/learn        learns from recorded flights (out/learn --help)'
	@echo '  make out/gap          says what a vehicle file lacks (out/gap --help)'
	@grep -hE '^[a-z/_-]+:.*##' Makefile | sed -E 's/^([a-z/_-]+):[^#]*## /  make \1\t/' | expand -t 24
	@echo
	@echo '  Times are rough, of two idle cores, once built; building takes a minute, on a bare machine ten with the packages.'
	@echo '  O=DIR puts all that is made into DIR (out); OPT, SANITIZE, CC, CXX: other flags and compilers build anew.'

.PHONY: help debug fast fresh demo desk flights touches robust passing by-height bound recorded example-seeds mass-flights slot faults exam test check fuzz bench lint arrows format clean sanitize clang setup setup-lint docs force pictures compile_commands firmware cload pil seeded add-effect tests-built report setup-pil setup-cf test-cf test-desk mutants coverage outside

# --- packages ---------------------------------------------------------------------------------------

# One target and one list, whatever is asked for: two apt-gets side by side fight for a lock.
setup:  ## install the Debian packages that demo and test need; minutes
	@tools/setup.sh $(PACKAGES) $(if $(filter $(LINT_GOALS),$(MAKECMDGOALS)),$(LINT_PACKAGES))
setup-lint: setup
setup-pil:  ## install the cross compiler and the emulator of the Crazyflie's processor; minutes
	@tools/setup.sh $(PIL_PACKAGES)
setup-cf:  ## cflib for tools/cf.py and cfloader for cload, into out/cf; a minute
	@tools/setup.sh $(CF_PACKAGES)
	@tools/cf/venv.sh

# --- objects and programs -----------------------------------------------------------------------------

# Objects are older than the flags that they are made with: other flags make them anew.
FLAGS = $(C) $(FLIGHT_FLAGS) $(OMP) | $(CPP)
ifneq ($(FLAGS),$(file <$(B)/flags))
$(B)/flags: force
endif
$(B)/flags:
	@mkdir -p $(@D)
	@printf '%s\n' '$(FLAGS)' >$@

# `compiling 40 of 359`: each where a person looks on, else every twentieth. How many there are is asked of a make that
# makes nothing, when the first is begun.
ifdef COUNTING
begin = : compiling
else
TOTAL = $(eval TOTAL := $(shell env -u MAKEFLAGS $(MAKE) -n COUNTING=1 $(foreach v,B O CC CXX OPT FAST SANITIZE,'$(v)=$($(v))') $(MAKECMDGOALS) 2>/dev/null | grep -c '^: compiling'))$(TOTAL)
said  = compiling $(words $(BEGUN)) of $(TOTAL)
begin = $(eval BEGUN += x)mkdir -p $(@D); if [ -t 2 ]; then printf '\r  $(said) ' >&2; \
  else $(if $(filter %00 %20 %40 %60 %80,$(words $(BEGUN))),echo '  $(said)' >&2,:); fi
force_tables = force
endif
link  = mkdir -p $(@D); [ ! -t 2 ] || printf '\r%40s\r' '' >&2; $(LINKER) $(FAST) $(SANITIZE) $(filter-out $(B)/flags,$^)

# The include path is the architecture: what each folder sees, the folder's own line where it has one. Flight code and
# nature do not see each other.
$(B)/%.o: SEES = -Iinclude -Isrc -Isim
$(B)/test/%.o $(B)/gen/%.o: SEES = -Iinclude -Isrc -Isim -Itest
$(B)/src/%.o: SEES = $(SEES_OF_SRC)
SEES_OF_SRC = $(FLIGHT_FLAGS) -Iinclude
# The app, unchanged, between stand-ins of the firmware's headers.
$(B)/src/firmware/%.o: SEES = $(SEES_OF_APP)
# Logs, parameters and events are listed in the linker's order: a program that is optimised as a whole would shuffle them.
$(B)/src/firmware/telemetry.o $(B)/src/firmware/recorder.o: SEES = $(SEES_OF_APP) $(if $(FAST),-fno-lto)
SEES_OF_APP = $(FLIGHT_FLAGS) -Iinclude -Isim/crazyflie -include here.h
$(foreach room,base plant effects vehicle body sense,$(B)/sim/$(room)/%.o): SEES = -Isim $(FLIGHT_FLAGS)
$(B)/sim/base/random.o: SEES = -Isim $(FLIGHT_FLAGS) -fno-math-errno
$(B)/sim/crazyflie/%.o $(B)/sim/link/%.o $(B)/sim/drone/%.o $(B)/sim/desk/%.o: SEES = -Iinclude -Isrc -Isim -Isim/crazyflie
$(B)/test/unit/src/firmware/%.o: SEES = -Iinclude -Isrc -Isim -Itest -Isim/crazyflie
$(B)/test/pil/%.o: SEES = -Iinclude -Isrc -Isim/crazyflie -Isim -Itest
# The exam's second plant sees nothing of the first.
$(B)/test/exam/other/%.o: SEES = -Itest
# Eight vehicles side by side: C compiled as C++, and with what lane_possible() has asked the processor for.
$(B)/sim/body/lanes.o: SEES = -Isim -I$(O)/gen $(FLIGHT_FLAGS) $(LANES)
$(B)/sim/body/lanes.o $(B)/sim/body/lanes_512.o: $(O)/gen/lanes_table.inc
# Once more with registers twice as wide, where the processor has them (lane_bits() of base/lane.h).
$(B)/sim/body/lanes_512.o: SEES = -Isim -I$(O)/gen $(FLIGHT_FLAGS) $(LANES) -DLANES_512 $(AVX512)
$(B)/sim/body/lanes_512.o: sim/body/lanes.cpp $(B)/flags | setup
	$(compile)
AVX512 = $(if $(AVX2),-mavx512f -mprefer-vector-width=512 $(MOVES:256=512))
# What is compiled by lane_c.hpp, too: registers of 256 bits, but twice as many, and masks.
AVX512VL = $(if $(AVX2),-mavx512f -mavx512vl -mavx512dq -mavx512bw -DLANES_512 -Dlanes=lanes_512)
AVX2 = $(if $(filter x86_64,$(shell uname -m)),-mavx2 -mtune=haswell)
# Their sources go through tools/lanes.sed first, headers too.
LANES_CPP  = $(CXX) -std=c++20 $(OPT) $(MOVES) $(WARN) $(LANES_WARN) $(SANITIZE) -MMD -MP $(FLIGHT_FLAGS) -fno-math-errno $(AVX2)
LANES_WARN = -Wno-psabi -Wno-extra -Wno-pedantic -Wno-shadow -Wno-conversion -Wno-missing-field-initializers -Wno-unused-function -Wno-c99-designator -Wno-return-type-c-linkage
LANES_SEE  = $(patsubst %,-I$(O)/gen/lanes/%,include src src/firmware sim sim/crazyflie) -Isim
LANES_SEEN = $(patsubst %,$(O)/gen/lanes/%,$(LANES_H))
$(O)/gen/lanes/%: % tools/lanes.sed
	@mkdir -p $(@D)
	@sed -zEf tools/lanes.sed $< >$@
define compile_in_lanes
@$(begin)
@mkdir -p $(@D)
@printf '%s\n' '#include "base/lane_c.hpp"' 'namespace lanes {' $(if $(filter src/firmware/%,$*),'#include "here.h"') '#include "$(abspath $<)"' '}' | \
 $(LANES_CPP) $(MORE) $(LANES_SEE) -MF $(@:.o=.d) -MT $@ -x c++ -o $@ -c -
endef
$(B)/lanes/%.o: $(O)/gen/lanes/%.c $(B)/flags | $(LANES_SEEN) setup
	$(compile_in_lanes)
$(B)/lanes_512/%.o: MORE = $(AVX512VL)
$(B)/lanes_512/%.o: $(O)/gen/lanes/%.c $(B)/flags | $(LANES_SEEN) setup
	$(compile_in_lanes)
$(B)/lanes/fields.o: sim/flight/lanes_fields.cpp $(B)/flags | $(LANES_SEEN) setup
	@$(begin)
	@mkdir -p $(@D)
	@$(LANES_CPP) -DLANE_FIELDS $(LANES_SEE) -c $< -o $@
$(B)/sim/flight/lanes_%.o: SEES = $(LANES_CPP:$(CXX)=) $(LANES_SEE)
$(B)/sim/flight/lanes_%_512.o: SEES = $(LANES_CPP:$(CXX)=) $(AVX512VL) $(LANES_SEE)
$(B)/sim/flight/lanes_fields.o $(B)/sim/flight/lanes_state.o $(B)/sim/flight/lanes_ms.o $(B)/sim/flight/lanes_ms_512.o: | $(LANES_SEEN)
$(B)/sim/flight/lanes_ms_512.o: sim/flight/lanes_ms.cpp $(B)/flags | setup
	$(compile)
LANES = -DLANES_TABLE='"lanes_table.inc"' -std=c++20 -fno-math-errno -Wno-pedantic -Wno-shadow -Wno-missing-field-initializers -Wno-unused-function $(AVX2)
# They fly many vehicles at once, or form many columns; or say how threads wait.
$(B)/sim/base/threads.o $(B)/sim/flight/many.o $(B)/sim/gap/%.o $(B)/sim/body/side_by_side.o $(B)/test/exam/main.o $(B)/test/exam/users_main.o $(B)/test/faults/test_faults.o $(B)/test/unit/sim/gap/test_gap_threads.o: MANY = $(OMP) $(FLIGHT_FLAGS)

define compile
@$(begin)
@$(if $(filter %.cpp,$<),$(CPP),$(C)) $(SEES) $(MANY) -c $< -o $@
endef
$(B)/%.o: %.c $(B)/flags | setup
	$(compile)
$(B)/%.o: %.cpp $(B)/flags | setup
	$(compile)
$(B)/gen/%.o: $(O)/gen/%.c $(B)/flags | setup
	$(compile)

$(O)/gen/%_table.c: $(force_tables) | setup
	@tools/table.sh $* $@
$(O)/gen/lanes_table.inc: $(force_tables) | setup
	@tools/table.sh lanes $@
$(O)/gen/version.c: $(force_tables)
	@tools/version.sh $@
$(O)/gen/page.c: sim/desk/page.html tools/page.py | setup
	@$(PYTHON) tools/page.py $< $@

# A program: what is its own, and the simulator.
TESTS_OBJ = $(call objects,$(TEST_SRC)) $(B)/gen/test_table.o $(DESK_OBJ) $(SIM_OBJ)
FUZZED    = csv usd link
FUZZ_OBJ  = $(call objects,test/fuzz/fuzz.c test/rig/flight_csv.c test/rig/usd_bytes.c test/rig/scratch.c)
$(PROGRAMS:%=$(B)/bin/%): $(B)/bin/%: $(B)/tools/%.o
$(B)/bin/bench: $(B)/tools/bench_gap.o
$(B)/bin/tests: $(TESTS_OBJ)
$(B)/bin/desk: $(DESK_OBJ)
$(B)/bin/tests $(B)/bin/desk: LIBS += $(DESK_LIBS)
$(B)/bin/exam: $(call objects,$(EXAM_SRC))
$(B)/bin/pil-record: $(B)/test/pil/record.o $(B)/test/pil/pil.o
$(B)/bin/fuzz_csv $(B)/bin/fuzz_usd: $(B)/bin/%: $(B)/test/fuzz/%.o $(FUZZ_OBJ)
$(B)/bin/fuzz_link: $(B)/test/fuzz/fuzz_link.o
$(FUZZED:%=$(B)/bin/fuzz_%): LINKER = $(CXX) -fsanitize=fuzzer
LINKER = $(CC)
$(B)/bin/%: $(SIM_OBJ)
	@$(link) $(LIBS) -o $@

$(PROGRAMS:%=$(O)/%) $(O)/exam: $(O)/%: $(B)/bin/%
	@ln -sfr $< $@

-include $(shell find $(B) -name '*.d' 2>/dev/null)

# --- what people do -----------------------------------------------------------------------------------

PYTHON = PYTHONDONTWRITEBYTECODE=1 python3
DOC    = DATA="$(DATA)" $(PYTHON) tools/doc/doc.py
# They share the cores already.
TESTS  = DATA="$(DATA)" PROGRAMS=$(B)/bin OMP_NUM_THREADS=1 $(B)/bin/tests "$(W)"
# What is built in another way, in a folder of its own: followed by the flags.
built  = $(MAKE) B=$(B) $(TESTED:%=$(B)/bin/%)
sanitize clang coverage: B = $(O)/$@

demo: setup $(O)/fly $(O)/learn $(O)/gap  ## fly, learn, compare, find what is hidden, draw (DATA=DIR adds real flights); a minute
	@$(DOC) show demo gap

flights: setup $(O)/fly  ## the thesis's flights: seven controllers, ten seeds, tables and pictures; a minute
	@$(DOC) show flights

touches: $(O)/fly  ## how often the thesis's flights touch the ceiling, 1,000 flights each; minutes
	@$(DOC) show touches

robust: $(O)/fly  ## the law that ships at 20 mm where one or two things of the plant are not as told, 100 flights each; 10 min
	@$(DOC) show robust

passing: $(O)/fly  ## learning without a learning flight and between floor and ceiling, and pushing against a ceiling; 10 min
	@$(DOC) show passing channel pushes

by-height: $(O)/bound $(O)/fly  ## the law by the flight code's own height, 1,000 flights each, beside the estimator's and the bound; 10 min
	@$(DOC) show by-height

bound: $(O)/bound $(O)/fly  ## the least height error that any controller could have, and what is flown as a ratio to it; minutes
	@$(DOC) show bound

example-seeds: $(O)/fly $(O)/gap  ## the workflow's example on other seeds, where a ceiling or nothing is hidden; minutes
	@$(DOC) show seeds

mass-flights: $(O)/fly $(O)/gap  ## the workflow on test flights with 1, 3 and 5 g more mass (SEEDS="1 201": sets from these seeds, a line each); minutes
	@SEEDS="$(SEEDS)" $(DOC) show mass-flights

recorded: $(O)/gap  ## what the workflow finds in recorded flights (DATA=DIR); minutes
	@$(DOC) show recorded

slot: $(O)/slot  ## the hover in a gap, by form of the ceiling effect and weight (DATA=DIR: beside the real flights); a minute
	@$(O)/slot "$(DATA)"

test: $(B)/bin/tests $(O)/fly $(O)/gap $(O)/learn $(O)/effectiveness $(O)/bound  ## all tests (W=word: those whose file or name has it; DATA=DIR: real flights too; TIMES=1: and how long each took); a minute
	@$(TESTS)

faults: $(B)/bin/tests  ## faults and bad inputs, 1,000 flights each, and how often the flight ends as it should; 10 min
	@FAULTS_TABLE=1 TEST_LONG=1 $(B)/bin/tests faults_of_the_list

test-cf: $(O)/desk $(O)/fly  ## the tests of tools/cf.py, over a fake link and at the desk, with the stock cflib (W=word: those whose name has it); minutes
	@test/cf/run.sh "$(CF_PACKAGES)" "$(W)"

test-desk: $(B)/bin/desk  ## the desk's page in a Chromium without a window (W=word: those whose name has it); skips without one; a minute
	@PROGRAMS=$(B)/bin test/desk/run.sh "$(DESK_PACKAGES)" "$(W)"

exam: $(O)/exam  ## the hidden-effect exam: 200 data sets, and 320 of users, diagnosed and marked (SEED=FIRST); 5 min
	@$(O)/exam $(or $(SEED),226001) 200
	@$(O)/exam users $(or $(SEED),234001) 320

outside: $(O)/gap  ## vehicles of rotorpy with something hidden, diagnosed and marked (SEED=S SETS=40); skips without rotorpy; half an hour
	@tools/outside.sh $(or $(SEED),1) $(or $(SETS),40) "$(CF_PACKAGES)"

check: test test-desk sanitize clang  ## the long tests, also with sanitizers and clang, and the seeded traps; an hour
	@TEST_LONG=1 $(TESTS)
	+@TEST_LONG=1 $(MAKE) test-cf W=
	@STORM_TICKS=10000000 $(O)/sanitize/bin/tests test_storm
	+@test/seeded/seeded.sh
	+@$(MAKE) mutants N=40 SEED=$(or $(SEED),1) W=
	+@$(MAKE) add-effect | grep -q '^cable: '

sanitize:  ## the tests with address and undefined-behaviour sanitizers; 10 min
	+@$(built) OPT='-O1 -g' SANITIZE='-fsanitize=address,undefined -fno-sanitize-recover=all'
	@$(TESTS)

debug:  ## the programs and the tests, not optimised, for a debugger: out/debug/bin; a minute
	@$(MAKE) B=$(O)/debug OPT='-O0 -g3' $(patsubst %,$(O)/debug/bin/%,tests $(PROGRAMS))

# The same bits: nothing is fused, and C++ stays as it is, for Eigen takes its sums in as many parts as a register holds.
# Warnings are the other build's to give: this one's are of code that was inlined. Which branches are taken a first build
# counts, in one thread: alone, side by side, in a diagnosis.
FASTER = -march=x86-64-v3 -mno-fma -ffp-contract=off -flto=auto -w
COUNTS = -fprofile-generate -fprofile-update=single
COUNT  = @OMP_NUM_THREADS=1 $(O)/counted/bin
fast: setup $(O)/fly  ## the programs for an x86-64-v3 (AVX2), optimised as a whole, to the same bits, and faster alone: out/fast/bin; ten minutes
	+@$(MAKE) B=$(O)/counted FAST='$(FASTER) $(COUNTS)' $(O)/counted/bin/fly $(O)/counted/bin/gap
	@find $(O)/counted -name '*.gcda' -delete
	$(COUNT)/fly learning-flight --log $(O)/counted/log.csv --log-rate 500 >$(O)/counted/said
	$(COUNT)/fly test-flight --integrator rk4 --from 1 --to 16 --summary $(O)/counted/many >$(O)/counted/said
	$(COUNT)/gap --vehicle sim/vehicle/vehicles/cf21_legacy.toml --columns tools/columns/fly.toml --out $(O)/counted/report $(O)/counted/log.csv >$(O)/counted/said 2>&1
	@mkdir -p $(O)/fast && cd $(O)/counted && find . -name '*.gcda' -exec cp --parents -t ../fast {} +
	+@$(MAKE) B=$(O)/fast FAST='$(FASTER) -fprofile-use' $(PROGRAMS:%=$(O)/fast/bin/%)
	@$(O)/fly learning-flight --log $(O)/fast/want.csv >$(O)/fast/want
	@$(O)/fast/bin/fly learning-flight --log $(O)/fast/got.csv >$(O)/fast/got
	@cmp $(O)/fast/want.csv $(O)/fast/got.csv

clang: setup-lint  ## everything again, and the tests, with clang; minutes
	+@$(built) CC=clang CXX=clang++
	@$(TESTS)

FUZZ_S = 60
fuzz: setup-lint  ## both log readers, and a vehicle that flies at the desk, on any bytes, FUZZ_S=60 seconds each; minutes
	@$(MAKE) B=$(O)/fuzz CC=clang CXX=clang++ OPT='-O1 -g' SANITIZE='-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all' $(FUZZED:%=$(O)/fuzz/bin/fuzz_%)
	@mkdir -p $(FUZZED:%=$(O)/fuzz/%)
	@cd $(O)/fuzz && for log in $(FUZZED); do bin/fuzz_$$log -max_total_time=$(FUZZ_S) -max_len=4096 -len_control=0 -timeout=5 -rss_limit_mb=512 -verbosity=0 -print_final_stats=1 $$log || exit 1; done

DESK_STORAGE = $(O)/desk.storage
desk: setup $(O)/desk  ## a simulated Crazyflie that the stock client and library fly, until Ctrl-C (SCENE=FILE.toml)
	@$(O)/desk $(SCENE) --storage $(DESK_STORAGE)

bench: $(O)/bench  ## how fast it is, as ratios to real time, and how a diagnosis grows with the log; a minute (BEFORE=COMMIT: beside that one)
	@$(if $(BEFORE),BEFORE="$(BEFORE)" $(DOC) show bench-before,$(O)/bench)

lint: setup-lint  ## format, static analysis, headers alone, house rules; minutes
	+@tools/lint/lint.sh

arrows: setup-lint  ## draw which folder takes from which: out/arrows.svg; seconds
	@mkdir -p $(O)
	@$(PYTHON) tools/lint/arrows.py --svg >$(O)/arrows.svg

# What make itself would type, but for what clang does not take, for an editor's language server (.clangd) and for
# clang-tidy (.clang-tidy).
compile_commands: setup  ## out/compile_commands.json, for an editor or clang-tidy; seconds
	@env -u MAKEFLAGS $(MAKE) -nB COUNTING=1 MOVES= $(B)/bin/pil-record $(TESTED:%=$(B)/bin/%) $(PROGRAMS:%=$(O)/%) $(O)/exam 2>/dev/null | \
	 sed -nE 's|["\\]|\\&|g; s|.* -c ([^ ]+) -o .*|{"directory": "$(CURDIR)", "command": "&", "file": "\1"},|p' | \
	 sed '1s/^/[/; $$s/,$$/]/' >$(O)/compile_commands.json

format: setup-lint  ## bring every source into the one format; seconds
	@clang-format -i $$(find include src sim test tools -name '*.[ch]' -o -name '*.cpp' -o -name '*.hpp')

docs: setup $(O)/fly $(O)/gap $(O)/learn $(O)/effectiveness $(O)/slot $(O)/bench $(O)/bound $(O)/desk $(O)/exam $(B)/bin/tests  ## write the tables and figures of every README.md (W=word: those whose name has it); an hour
	+@$(DOC) write $(W)

pictures: demo  ## draw the READMEs' pictures into .doc; a minute
	@$(DOC) write picture

tests-built: $(B)/bin/tests $(O)/fly $(O)/learn $(O)/effectiveness $(O)/bound

seeded:  ## steps into every trap of test/seeded and expects the tests to say so (W=word); half an hour
	+@test/seeded/seeded.sh "$(W)"

# The flight code as written, without the optimiser's own branches; the rest need not be slow.
coverage:  ## which lines and branches the tests run, by folder; of src and src/firmware every branch (DATA=DIR)
	+@$(built) OPT=-O1 SANITIZE=--coverage WARN= FLIGHT_FLAGS='$(FLIGHT_FLAGS) -O0'
	@find $(B) -name '*.gcda' -delete
	@$(TESTS)
	@$(PYTHON) test/coverage/coverage.py $(B)

# N mistakes of one token or statement each; what is expected of the tests stands in test/mutants/mutants.py.
N = 300
mutants: $(B)/bin/tests  ## small mistakes in the flight code, and which no test notices (N=300 SEED=s W=word of a file); an hour
	@$(PYTHON) test/mutants/test_mutate.py
	@FLIGHT='$(C) $(SEES_OF_SRC)' APP='$(C) $(SEES_OF_APP)' \
	 LINK='$(CC) $(SANITIZE)' LIBRARIES='$(LIBS) $(DESK_LIBS)' OBJECTS='$(TESTS_OBJ)' \
	 $(PYTHON) test/mutants/mutants.py $(N) $(or $(SEED),1) "$(W)"

pil:  ## the app on an emulated Cortex-M4F: its objects, its bits, its cost (setup-pil installs what it needs); minutes
	+@test/pil/pil.sh

add-effect: $(O)/fly $(O)/gap  ## try the page on adding an effect (sim/effects), in a copy of the tree; a minute
	+@$(DOC) show cable

report: setup  ## the image's size (after make firmware) and the target's figures into the READMEs; minutes
	+@$(DOC) write image pil

firmware:  ## the Crazyflie's image, for legacy and for 2.1+ propellers (CRAZYFLIE_BASE=DIR: the firmware's source); minutes
	+@tools/firmware.sh build "$(CRAZYFLIE_BASE)" legacy
	+@tools/firmware.sh build "$(CRAZYFLIE_BASE)" plus
	@cat $(O)/firmware/legacy/size $(O)/firmware/plus/size >$(O)/firmware/size

cload:  ## build, and flash over the radio (CRAZYFLIE_BASE=DIR PROPELLERS=legacy or plus); minutes
	+@tools/firmware.sh cload "$(CRAZYFLIE_BASE)" "$(PROPELLERS)"

fresh:  ## the README's commands in a bare Debian 12, as root and as a user (root, debootstrap); half an hour
	+@tools/ci/fresh.sh

clean:  ## remove everything that was made
	@rm -rf $(O)

# Counted is by a make that must do nothing, not even what stands behind a +.
ifdef COUNTING
SHELL = /bin/true
endif
