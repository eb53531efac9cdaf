# shodo: `make` builds build/shodo. Other targets: rooms, pictures, textures, luminaires, report, test, truth, hard,
# stability, load, coverage, check-same-bytes, fuzz, soak, mutants, machines, workstation, case-cost, scaling, memory-cost, check-budgets,
# install, install-needs, clean.
#
# Settings, on the command line of make:
#   CXX=clang++ OPT=-O0   another compiler or optimisation; what was built with other flags is built again
#   BUILD=DIR             where everything goes that is built
#   PREFIX=DIR DESTDIR=DIR   where `make install` puts the program and the library

OPT = -O2
BUILD = build
OUT = out
PREFIX = /usr/local
DESTDIR =

# The same bits everywhere: no contraction of a * b + c into one rounding. The library knows no exceptions.
COMMON_FLAGS = -std=c++20 $(OPT) -ffp-contract=off -Wall -Wextra -Wconversion -Werror -Isrc -Iinclude
LIBRARY_FLAGS = $(COMMON_FLAGS) -fno-exceptions -fno-rtti -fstack-usage
PROGRAM_FLAGS = $(COMMON_FLAGS)
TEST_FLAGS = $(COMMON_FLAGS) -I. -Itests

LIBRARY_SOURCES = $(filter-out src/cli/%,$(wildcard src/*.cpp src/*/*.cpp))
PROGRAM_SOURCES = $(wildcard src/cli/*.cpp)
TEST_SOURCES = $(wildcard tests/*/*_test.cpp tests/support/*.cpp tests/hard/*_cases.cpp) \
  $(addprefix tests/hard/,run.cpp scene_text.cpp variants.cpp)
objects = $(patsubst %.cpp,$(BUILD)/objects/%.o,$(1))
LIBRARY_OBJECTS = $(call objects,$(LIBRARY_SOURCES))
PROGRAM_OBJECTS = $(call objects,$(PROGRAM_SOURCES))
TEST_OBJECTS = $(call objects,$(TEST_SOURCES))
# Tests see and refuse the library's blocks (tests/support/arena_hook.h), where a size_t has 64 bits.
TEST_LINK = -Wl,--wrap=_ZN5shodo5Arena10take_bytesEPKcm -Wl,--wrap=_ZN5shodo5Arena16take_spare_bytesEPKcm
# The program but for main(), for the tests of its parts.
PROGRAM_PARTS = $(filter-out $(BUILD)/objects/src/cli/main.o,$(PROGRAM_OBJECTS))

all: $(BUILD)/shodo

# A stamp holds a line of settings and changes only with it.
define stamp
	@mkdir -p $(@D)
	@echo '$(1)' | cmp -s - $@ || echo '$(1)' > $@
endef

$(BUILD)/flags.stamp: FORCE
	$(call stamp,$(CXX) $(COMMON_FLAGS) $(CXXFLAGS) $(LDFLAGS))
$(BUILD)/library.stamp: FORCE
	$(call stamp,$(LIBRARY_OBJECTS))
$(BUILD)/program.stamp: FORCE
	$(call stamp,$(PROGRAM_OBJECTS))
$(BUILD)/tests.stamp: FORCE
	$(call stamp,$(TEST_OBJECTS))

$(LIBRARY_OBJECTS): FLAGS = $(LIBRARY_FLAGS)
$(PROGRAM_OBJECTS): FLAGS = $(PROGRAM_FLAGS)
$(TEST_OBJECTS): FLAGS = $(TEST_FLAGS)
$(BUILD)/objects/%.o: %.cpp $(BUILD)/flags.stamp
	@mkdir -p $(@D)
	$(CXX) $(FLAGS) $(CXXFLAGS) -MMD -MP -c $< -o $@

$(BUILD)/libshodo.a: $(LIBRARY_OBJECTS) $(BUILD)/library.stamp
	@rm -f $@
	$(AR) rcs $@ $(LIBRARY_OBJECTS)

$(BUILD)/shodo: $(PROGRAM_OBJECTS) $(BUILD)/libshodo.a $(BUILD)/program.stamp
	$(CXX) $(OPT) $(CXXFLAGS) $(LDFLAGS) $(PROGRAM_OBJECTS) $(BUILD)/libshodo.a -o $@

$(BUILD)/tests: $(TEST_OBJECTS) $(PROGRAM_PARTS) $(BUILD)/libshodo.a $(BUILD)/tests.stamp | $(BUILD)/system_faults.so
	$(CXX) $(OPT) $(CXXFLAGS) $(LDFLAGS) $(TEST_LINK) $(TEST_OBJECTS) $(PROGRAM_PARTS) $(BUILD)/libshodo.a \
	  -lgtest_main -lgtest -lpthread -o $@

# Paths by chance: what the ambient light should be (doc/proof.md).
TRUTH_OBJECTS = $(BUILD)/objects/tests/truth/main.o
$(TRUTH_OBJECTS): FLAGS = $(TEST_FLAGS)
truth: $(BUILD)/shodo $(BUILD)/truth
	sh tools/truth
$(BUILD)/truth: $(TRUTH_OBJECTS) $(BUILD)/libshodo.a
	$(CXX) $(OPT) $(CXXFLAGS) $(LDFLAGS) $(TRUTH_OBJECTS) $(BUILD)/libshodo.a -lpthread -o $@

# Stands between the program and the system, for tests.
$(BUILD)/system_faults.so: tests/faults/system_faults.cpp $(BUILD)/flags.stamp
	$(CXX) $(COMMON_FLAGS) -shared -fPIC $< -ldl -o $@

# Speed against error in both rooms, with the paper's table; what workstation, case-cost, scaling and
# memory-cost left is told too.
report: $(BUILD)/shodo
	@mkdir -p $(OUT)
	rm -rf $(OUT)/report
	$(BUILD)/shodo report data/day.scn data/evening.scn -o $(OUT)/report

# The paper's two figures.
rooms: $(OUT)/day.png $(OUT)/evening.png

$(OUT)/%.png: data/%.scn $(BUILD)/shodo $(wildcard data/* data/*/*)
	@mkdir -p $(OUT)
	$(BUILD)/shodo render $< -o $@ --stats $(OUT)/$*.json

# Those of doc/pictures.md.
PICTURE_SCENES = cornell white_box door stair studio garden gallery office
VIEWS = false-colour isolux patches day-maps evening-maps day-window evening-window
pictures: doc/pictures/day.png doc/pictures/evening.png doc/pictures/difference.png \
  $(PICTURE_SCENES:%=doc/pictures/%.png) $(VIEWS:%=doc/pictures/%.png)
doc/pictures/day.png doc/pictures/evening.png: doc/pictures/%.png: $(OUT)/%.png
	cp $< $@
doc/pictures/day-maps.png doc/pictures/day-window.png: SCENE = day
doc/pictures/evening-maps.png doc/pictures/evening-window.png: SCENE = evening
doc/pictures/day-maps.png doc/pictures/evening-maps.png: SHOWN = --effects off
doc/pictures/day-window.png doc/pictures/evening-window.png: SHOWN = --camera window
$(PICTURE_SCENES:%=doc/pictures/%.png): SCENE = $(basename $(notdir $@))
doc/pictures/false-colour.png: SCENE = evening
doc/pictures/false-colour.png: SHOWN = --false-colour auto --isolux auto
doc/pictures/isolux.png: SCENE = door
doc/pictures/isolux.png: SHOWN = --isolux auto
doc/pictures/patches.png: SCENE = stair
doc/pictures/patches.png: SHOWN = --show patches
doc/pictures/%.png: $(BUILD)/shodo $(wildcard data/* data/*/*)
	$(BUILD)/shodo render data/$(SCENE).scn -o $@ --size 400x320 $(SHOWN)
doc/pictures/difference.png: $(BUILD)/shodo data/door.scn
	@mkdir -p $(OUT)
	$(BUILD)/shodo render data/door.scn -o $(OUT)/door.ppm --size 400x320
	$(BUILD)/shodo render data/door.scn -o $(OUT)/door-2.ppm --size 400x320 --rules 2
	$(BUILD)/shodo difference $(OUT)/door.ppm $(OUT)/door-2.ppm -o $@

# The pictures of data/textures; TEXTURES: where to.
TEXTURES = data/textures
$(BUILD)/paint: tools/paint.cpp $(BUILD)/flags.stamp
	$(CXX) $(COMMON_FLAGS) $< -o $@
textures: $(BUILD)/paint
	$(BUILD)/paint $(TEXTURES)

# The files of data/luminaires.
luminaires:
	sh tools/luminaires

test: $(BUILD)/shodo $(BUILD)/tests $(BUILD)/paint
	@BUILD=$(BUILD) sh tests/run

# All hard cases with their long sweeps: the table, and out/hard.csv (number,name,status,figure).
hard: $(BUILD)/tests
	@mkdir -p $(OUT)
	SHODO_HARD=all SHODO_HARD_TABLE=$(OUT)/hard.csv $(BUILD)/tests --gtest_brief=1 --gtest_filter='HardTable.*'

# The plots and tables of doc/stability.md.
stability: $(BUILD)/tests
	SHODO_HARD=all SHODO_STABILITY=doc/pictures $(BUILD)/tests --gtest_brief=1 --gtest_filter='Stability.*:Convergence.*'

# Scenes and pictures as large as the budgets of doc/stability.md allow; takes minutes.
load: $(BUILD)/shodo $(BUILD)/tests
	SHODO_HARD=all $(BUILD)/tests --gtest_filter='Load.*:Metamorphic.*'

# The library with counters, nothing inlined so that every line counts once, the tests as they are: out/coverage.txt.
COVERED_OBJECTS = $(patsubst %.cpp,$(BUILD)/coverage/objects/%.o,$(LIBRARY_SOURCES))
$(COVERED_OBJECTS): $(BUILD)/coverage/objects/%.o: %.cpp $(BUILD)/flags.stamp
	@mkdir -p $(@D)
	$(CXX) $(LIBRARY_FLAGS) $(CXXFLAGS) -O1 -fno-inline --coverage -MMD -MP -c $< -o $@
$(BUILD)/coverage/tests: $(COVERED_OBJECTS) $(BUILD)/tests
	$(CXX) $(OPT) $(CXXFLAGS) $(LDFLAGS) --coverage $(TEST_LINK) $(TEST_OBJECTS) $(PROGRAM_PARTS) $(COVERED_OBJECTS) \
	  -lgtest_main -lgtest -lpthread -o $@
coverage: $(BUILD)/shodo $(BUILD)/coverage/tests
	@BUILD=$(BUILD) sh tools/coverage

# Only the comparison of compilers and optimisation levels; part of `make test`.
check-same-bytes:
	@sh tests/same_bytes

# Three fuzzers under sanitizers; FUZZ_SECONDS of each. Part of `make test` with a minute.
FUZZ_SECONDS = 60
fuzz:
	@sh tests/fuzz/run $(FUZZ_SECONDS)

# An hour of fuzzing, then 10^8 pairs of segment and triangle against the 128-bit twin and 10^7 segments at seams.
soak: $(BUILD)/tests
	@sh tests/fuzz/run 1800
	SHODO_SOAK=50 $(BUILD)/tests --gtest_filter='TriangleTest.*:Leaks.*'

# The core's code with one sign changed, and whether the tests see it: out/mutants.csv. MUTANTS, JOBS: tests/mutants/run.
MUTANTS =
mutants: $(BUILD)/shodo $(BUILD)/tests
	@BUILD=$(BUILD) OUT=$(OUT) COMPILE='$(CXX) $(LIBRARY_FLAGS) $(CXXFLAGS)' LINK='$(CXX) $(OPT) $(CXXFLAGS) $(LDFLAGS)' \
	  TEST_OBJECTS='$(TEST_LINK) $(TEST_OBJECTS) $(PROGRAM_PARTS)' PROGRAM_OBJECTS='$(PROGRAM_OBJECTS)' \
	  sh tests/mutants/run $(MUTANTS)

# The program, the library with its headers, what pkg-config and man read (doc/library.md).
VERSION = $(shell sed -n 's/.*kVersion = "shodo \(.*\)".*/\1/p' src/cli/arguments.h)
INSTALLED = $(DESTDIR)$(PREFIX)
install: $(BUILD)/shodo $(BUILD)/libshodo.a
	mkdir -p $(INSTALLED)/bin $(INSTALLED)/lib/pkgconfig $(INSTALLED)/include/shodo $(INSTALLED)/share/man/man1
	install -m 755 $(BUILD)/shodo $(INSTALLED)/bin/shodo
	install -m 644 $(BUILD)/libshodo.a $(INSTALLED)/lib/libshodo.a
	install -m 644 include/shodo/*.h $(INSTALLED)/include/shodo
	install -m 644 doc/shodo.1 $(INSTALLED)/share/man/man1/shodo.1
	sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@VERSION@|$(VERSION)|' tools/shodo.pc.in >$(INSTALLED)/lib/pkgconfig/shodo.pc
	chmod 644 $(INSTALLED)/lib/pkgconfig/shodo.pc

# Both rooms in the seconds of the paper's workstation, counted under QEMU: out/workstation.json.
workstation:
	@sh tools/workstation $(WORKSTATION_OPTIONS)

# What the cases of the report cost, in the same seconds: out/case-cost.csv, which the next report takes up.
case-cost: $(BUILD)/shodo
	@sh tools/case-cost

# What less memory costs, in the same seconds: out/memory-cost.csv, which the report draws.
memory-cost:
	@sh tools/memory-cost $(MEMORY_COST_OPTIONS)

# Both rooms with every budget in steps of 1 %: some ten minutes with blocks.
check-budgets:
	@sh tools/check-budgets $(MEMORY_COST_OPTIONS)

# The same scenes on many machines under QEMU: out/machines.txt, out/machines.csv; MACHINES="mips 'x86-64*'" runs some.
machines: $(BUILD)/shodo
	-@sh tools/install-needs machines
	@SHODO_PROGRAM=$(BUILD)/shodo sh tools/machines $(MACHINES)

# Cost against size with blocks: the table, fitted exponents, and out/scaling.csv.
scaling: $(BUILD)/shodo
	@sh tools/scaling

install-needs:
	sh tools/install-needs test

clean:
	rm -rf $(BUILD) $(OUT)

FORCE:
.PHONY: all rooms pictures textures luminaires report test truth hard stability load coverage check-same-bytes fuzz \
  soak mutants machines workstation case-cost scaling memory-cost check-budgets install install-needs clean FORCE
.SECONDARY:

-include $(COVERED_OBJECTS:.o=.d) $(LIBRARY_OBJECTS:.o=.d) $(PROGRAM_OBJECTS:.o=.d) $(TEST_OBJECTS:.o=.d) \
  $(TRUTH_OBJECTS:.o=.d)
