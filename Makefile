# gnomon. `make help` lists the targets.
#
# VARIANT: release debug asan size. CROSS: a board's compiler prefix (arm-linux-gnueabihf-, aarch64-linux-gnu-).
# SYSROOT: what the command is built against under CROSS. Without it, and without PKG_CONFIG_LIBDIR, for the two above a root
# of Debian is made in build/ (debootstrap).
# FEATURES: what the library can do; core/gni_features.h explains them. None leaves z-fail in a stencil of two sides. [all]
# FONT: what the viewer writes with.
# HOST_CC: what compiles for where the build runs, also when it is for a board.
# V=1 shows whole commands. CC, CFLAGS, CPPFLAGS, LDFLAGS, AR, PKG_CONFIG, PREFIX, DESTDIR mean what they mean everywhere.
VARIANT    ?= release
CROSS      ?=
PREFIX     ?= /usr/local
PKG_CONFIG ?= pkg-config
HOST_CC    ?= cc
HOST_PKG_CONFIG ?= env -u PKG_CONFIG_LIBDIR -u PKG_CONFIG_SYSROOT_DIR pkg-config
FONT       ?= /usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf
PYTHON     ?= python3
EVERY_FEATURE := culling batches fallback refine cache welding clusters solids proofs messages selector text
# Not from the environment: others use the name.
ifneq ($(origin FEATURES),command line)
FEATURES   := $(EVERY_FEATURE)
endif

ifeq ($(origin CC),default)
CC := $(CROSS)gcc
endif
ifeq ($(origin AR),default)
AR := $(CROSS)ar
endif

# A build with less has a folder of its own.
LACKS   := $(filter-out $(FEATURES),$(EVERY_FEATURE))
empty   :=
B       := build/$(notdir $(CROSS))$(VARIANT)$(if $(LACKS),-with$(subst $(empty) ,,$(addprefix -,$(sort $(FEATURES)))))
# For Debian's own two, and where no recipe says what the board has, a root of Debian is made for the command.
ARCH    := $(if $(SYSROOT)$(PKG_CONFIG_LIBDIR)$(PKG_CONFIG_SYSROOT_DIR),,$(if $(filter arm-linux-gnueabihf-,$(CROSS)),armhf,$(if $(filter aarch64-linux-gnu-,$(CROSS)),arm64)))
ifneq ($(ARCH),)
override SYSROOT := build/root-$(ARCH)
ROOT    := $(SYSROOT)/.whole
FOUND   := $(abspath $(SYSROOT))/usr
override PKG_CONFIG := env PKG_CONFIG_SYSROOT_DIR=$(abspath $(SYSROOT)) PKG_CONFIG_LIBDIR=$(FOUND)/lib/$(patsubst %-,%,$(CROSS))/pkgconfig:$(FOUND)/share/pkgconfig pkg-config
endif
SYSTEM  := $(addprefix --sysroot=,$(SYSROOT))
# Not with -L, by which links that are absolute in the root would be looked for here.
LIBS    := $(if $(ARCH),--libs-only-l)
D       := $(DESTDIR)$(PREFIX)
VERSION := $(shell awk '/define GN_VERSION_/ {printf dot $$3; dot = "."}' core/gnomon.h)

release := -O2
debug   := -Og -g
asan    := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
footprint := -Os -ffunction-sections -fdata-sections -fcallgraph-info=su
size    := -Os -ffunction-sections -fdata-sections
WARN    := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes
# -ffp-contract=off: the same floats with fused multiply-add and without (DESIGN.md, decision 1)
FLAGS    = -std=c99 $(SYSTEM_$(firstword $(subst /, ,$<))) $(WARN) $(WERROR) -ffp-contract=off $($(VARIANT)) $(INCLUDE) $(addprefix -DGNI_WITHOUT_,$(LACKS)) -MMD -MP $(CPPFLAGS) $(CFLAGS)

# What a feature is, by the files that a build without it has not: core/gni_features.h says what it then cannot do,
core     = $(patsubst %,core/%.c,$(1))
files_culling  := $(call core,bounds ends cases cells extent fronts intervals patches receivers slivers fan flats hull soft)
files_batches  := $(call core,batches sweep)
files_fallback   := $(call core,batches_color choose_color fragments) $(wildcard gles/fallback/*.c)
files_refine   := $(call core,plan_refine thin) gles/fallback/refine.c
files_cache    := $(call core,cache kept_masks kept_records streams)
files_clusters := $(call core,clusters order facing_floats)
files_welding  := $(call core,groups)
files_solids   := $(call core,embedded)
files_proofs   := $(wildcard gles/proofs/*.c) gles/show.c gles/host_state.c
files_selector := $(call core,select selector suitability knowledge learn loads possible fuzzy rules_about rules_default select_explain traffic rules scan slices knowledge_read)
files_text     := $(call core,explain plan_json)

# and which others it stands on.
needs_batches  := culling
needs_fallback := culling batches
needs_refine   := fallback
needs_cache    := culling
needs_selector := refine cache text
needs_text     := messages
$(foreach f,$(FEATURES),$(if $(filter-out $(EVERY_FEATURE),$f),$(error FEATURES has $f: it is some of $(EVERY_FEATURE)))\
  $(foreach n,$(needs_$f),$(if $(filter-out $(FEATURES),$n),$(error FEATURES: $f needs $n))))

# Each room sees only the rooms below it.
INC_port      := -Iport
INC_core      := $(INC_port) -Icore -I$(B)/rules
INC_gles      := $(INC_core) -Igles -I$(B)/gles
INC_platforms := -Iplatforms
INC_tools      = -D_POSIX_C_SOURCE=200809L $(INC_core) -Igles -Iplatforms -Itools -Itools/scene -Itools/truth -Itools/stage -Itools/measure -Itools/calibrate -Itools/view -I$(B)/tools/stage -I$(B)/tools/view $(shell $(PKG_CONFIG) --cflags libcjson libpng)
INC_examples  := $(INC_gles)
INC_tests      = $(INC_tools) -Itests/support $(shell $(PKG_CONFIG) --cflags cmocka)
INCLUDE        = $(INC_$(firstword $(subst /, ,$<)))

# The library needs headers of Khronos alone; the rest what the board has.
SYSTEM_platforms := $(SYSTEM)
SYSTEM_tools     := $(SYSTEM)
SYSTEM_tests     := $(SYSTEM)
SYSTEM_examples  := $(SYSTEM)
TOOL_LIBS  = $(shell $(PKG_CONFIG) $(or $(LIBS),--libs) libcjson libpng) -lmeshoptimizer -ldl -lm
TEST_LIBS  = $(shell $(PKG_CONFIG) $(or $(LIBS),--libs) cmocka) $(TOOL_LIBS)

Q       := $(if $(V),,@)
objects  = $(patsubst %.c,$(B)/%.o,$(wildcard $(1)))
WITHOUT := $(foreach f,$(LACKS),$(files_$f))
LIBRARY := $(call objects,port/port_libc.c $(filter-out $(WITHOUT),$(wildcard core/*.c gles/*.c gles/*/*.c)) $(wildcard $(LACKS:%=core/without/%.c)))
TOOLS   := $(filter-out $(B)/tools/main.o %/bake_font.o,$(call objects,tools/*.c tools/*/*.c platforms/*.c))
SUPPORT := $(filter-out %/keep_open.o,$(call objects,tests/support/*.c port/port_template.c))
# It calls all features.
COMMAND := $(if $(LACKS),,$(B)/gnomon)
SHADERS := $(patsubst %,$(B)/%.h,$(wildcard gles/shaders/* rules/default.fcl))
# Of the command alone: the library needs no font.
DRAWN   := $(patsubst %,$(B)/%.h,$(wildcard tools/stage/shaders/* tools/view/shaders/*)) $(B)/tools/view/font.h
COMPILER := rules/compile.c core/rules.c core/rules_about.c core/scan.c core/slices.c core/fuzzy.c core/context.c port/port_libc.c $(wildcard core/*.h)
TESTS   := $(patsubst %.c,$(B)/%,$(wildcard tests/*/test_*.c))
# What is run under qemu: not what takes minutes there.
ARM_TESTS := $(filter-out %/test_layers,$(patsubst %.c,$(B)/%,$(wildcard tests/core/test_*.c) tests/extremes/test_numbers.c tests/rules/test_rules.c tests/select/test_selector.c)) $(patsubst %,$(B)/tests/gles/test_%,formats hidden kept parts state targets)
BENCHES := $(patsubst %.c,$(B)/%,$(wildcard tests/bench/bench_*.c))
PUBLIC  := port/gn_port.h core/gnomon.h core/gn_plan.h core/gn_capability.h core/gn_matrix.h core/gn_rules.h core/gn_select.h gles/gnomon_gles.h gles/gn_glsl.h gles/gn_gl.h gles/gl_funcs.h
SCENES  := build/scenes/scenes.txt

.DEFAULT_GOAL := all
ifneq ($(and $(LACKS),$(filter demo test truth bench trade selector certify test-drivers test-arm boards asan valgrind footprint,$(MAKECMDGOALS))),)
$(error all features are needed, and FEATURES lacks $(LACKS))
endif
ifeq ($($(VARIANT)),)
$(error VARIANT is one of release debug asan size ($(VARIANT)))
endif

.PHONY: footprint measured footprint-page all deps deps-drivers demo test test-drivers test-arm arm-tests angle truth bench trade selector certify boards headers layers asan valgrind size sizes install install-lib format clean help check-build force
.SECONDARY:

all: $(B)/libgnomon.a $(COMMAND) $(call objects,port/port_template.c) ## build the library and the command

demo: $(B)/gnomon $(SCENES) ## draw a sundial in a courtyard, headless, into build/demo.png
	@$(B)/gnomon render build/scenes/courtyard.gltf -o build/demo.png --size 1280x800 --report build/demo.json
	@sed -n 's/^\t"\(driver\|renderer\|platform\)":\t"\(.*\)",$$/  \1: \2/p' build/demo.json
	@echo "build/demo.png: a sundial in a courtyard, three lights, exact stencil shadows"

test: $(TESTS) $(B)/examples/minimal $(B)/tests/truth/truth_table $(B)/tests/bench/bench_stencil $(B)/gnomon $(SCENES) headers layers check-build ## run every test of this VARIANT
	@sh tests/run.sh $(B) $(TESTS)

truth: $(B)/gnomon $(B)/tests/truth/truth_table $(SCENES) ## masks of all test scenes against the ray-traced truth
	@sh tests/truth/truth.sh $(B) $(TRUTH_ARGS)

bench: $(BENCHES) $(SCENES) ## what things cost: counts, and times as remarks; into tests/bench/*.csv (an hour; needs valgrind)
	@$(B)/tests/bench/bench_proofs > /dev/null && $(B)/tests/bench/bench_proofs
	@$(B)/tests/bench/bench_stencil > build/stencil.csv && mv build/stencil.csv tests/bench/stencil.csv
	@grep '^#' tests/bench/stencil.csv
	@$(B)/tests/bench/bench_methods > build/methods.csv && mv build/methods.csv tests/bench/methods.csv
	@$(B)/tests/bench/bench_ranges && $(B)/tests/bench/bench_small && $(B)/tests/bench/bench_roettger && $(B)/tests/bench/bench_refine
	@sh tests/bench/rebuild.sh $(B) "$(CC)" > build/rebuild.csv && mv build/rebuild.csv tests/bench/rebuild.csv
	@$(B)/tests/bench/bench_frames > build/frames.csv && mv build/frames.csv tests/bench/frames.csv

trade: $(B)/gnomon $(SCENES) ## the measured trade of docs/trade.md: the demo scene and others, and the rig (some minutes, a quiet machine)
	@mkdir -p build/trade build/rig
	@for spared in "" "--update-every 2" "--update-every 4" "--masks-every 2" "--masks-every 4" "--weld-angle 2" "--weld-angle 10" "--proxy 2000"; do \
	  $(B)/gnomon measure build/scenes/pile_of_8.gltf -o build/trade/spared --methods stencil --scales 1 --spin 2 --repeat 3 $$spared || exit 1; done
	@$(PYTHON) tests/scenes/rig.py build/rig
	@$(B)/gnomon measure $(patsubst %,build/scenes/%.gltf,courtyard colours pile_of_27 slats) -o build/trade --upsample bilinear,depth
	@$(B)/gnomon measure $(patsubst %,build/rig/rig_%.gltf,600 1600 5000 9700) -o build/rig/trade --scales 1 --lights 1,2,4,8,16 --frames 2 --repeat 5
	@$(B)/gnomon measure build/rig/rig_600.gltf -o build/rig/trade --scales 1 --lights 1 --frames 2 --repeat 5 --size 160x120,640x480,1024x768

selector: $(B)/gnomon $(BENCHES) $(SCENES) ## the figures of docs/selector.md: control, costs, predictions, the frontier (five minutes, a quiet machine)
	@$(B)/tests/bench/bench_control docs/control.svg > build/control.csv && mv build/control.csv tests/bench/control.csv
	@$(B)/tests/bench/bench_select
	@$(B)/gnomon calibrate -o build/knowledge.csv $(if $(wildcard build/trade/trade.csv),--trade build/trade/trade.csv)
	@$(B)/tests/bench/bench_predict build/knowledge.csv $$(awk '$$3 != "extreme" {print $$1}' build/scenes/scenes.txt) > build/predict.csv
	@$(B)/tests/bench/bench_frontier build/knowledge.csv $$(awk '$$3 != "extreme" {print $$1}' build/scenes/scenes.txt) > build/frontier.csv
	@grep -h '^#' build/predict.csv build/frontier.csv

certify: $(B)/gnomon $(SCENES) ## no exact method is wrong along a path round each test scene
	@$(B)/gnomon measure --certify $$(awk '$$3 != "extreme" {print "build/scenes/" $$1 ".gltf"}' build/scenes/scenes.txt)

test-drivers: $(B)/gnomon $(patsubst %.c,$(B)/%,$(wildcard tests/gles/test_*.c)) $(SCENES) ## masks and tests of tests/gles on every driver that is here, into docs/drivers.md (half an hour)
	@$(PYTHON) tests/drivers.py $(B) > build/drivers.md; status=$$?; mv build/drivers.md docs/drivers.md; exit $$status

deps-drivers: ## what Debian has of drivers and, for test-arm, of compilers and qemu: installs it as root, else prints the command
	@sh tools/deps.sh drivers

angle: build/angle/libEGL.so ## fetches ANGLE over SwiftShader by npm into build/, a driver for test-drivers

test-arm: $(B)/gnomon $(SCENES) ## builds for armhf and arm64 and runs it by qemu (debootstrap; a quarter of an hour)
	@$(MAKE) --no-print-directory CROSS=arm-linux-gnueabihf- arm-tests
	@$(MAKE) --no-print-directory CROSS=aarch64-linux-gnu- arm-tests
	@sh tests/arm.sh armhf build/arm-linux-gnueabihf-$(VARIANT) $(B) && sh tests/arm.sh arm64 build/aarch64-linux-gnu-$(VARIANT) $(B)
	@$(PYTHON) tests/drivers.py $(B) "armhf softpipe" "arm64 softpipe"
	@echo "armhf and arm64: as here"

arm-tests: $(B)/libgnomon.a $(B)/gnomon $(B)/examples/minimal $(ARM_TESTS)

boards: $(B)/gnomon ## probe every driver that this machine can run, into docs/boards.md
	@$(PYTHON) tests/boards.py $(B)/gnomon > build/boards.md && mv build/boards.md docs/boards.md

headers: ## each public header compiles alone, as C99 and, where there is a compiler for it, as C++
	@for h in $(PUBLIC); do case $$h in *gl_funcs.h) continue;; esac; \
	  echo 'extern int some;' | $(CC) -x c -std=c99 -Wall -Wextra -Wpedantic -Werror -Iport -Icore -Igles -include $$h -fsyntax-only - || exit 1; \
	  echo | $(CC) -x c++ -fsyntax-only - 2>/dev/null || continue; \
	  echo 'extern int some;' | $(CC) -x c++ -Wall -Wextra -Wpedantic -Werror -Iport -Icore -Igles -include $$h -fsyntax-only - || exit 1; done

layers: $(B)/libgnomon.a ## arrows point down only; the library takes memory from its port alone and has no globals
	@! grep -nE '#include.*(GL|EGL|gles|platform|scene)' core/*.[ch] core/without/*.c port/*.[ch]
	@! grep -nE '#include.*(EGL|X11|osmesa|GLFW|platform|scene)' gles/*.[ch] gles/*/*.[ch]
	@! grep -nE '#include.*(gnomon|gni|scene)' platforms/*.[ch]
	@! grep -nE '#include.*gni' tools/*.[ch] tools/*/*.[ch]
	@! $(CROSS)nm -u $(filter-out %/port_libc.o,$(LIBRARY)) | grep -E ' U (e?gl[A-Z].*|malloc|calloc|realloc|free|fopen|printf)$$'
	@[ $(VARIANT) = asan ] || $(CROSS)size -A $(LIBRARY) | awk '$$1 ~ /^\.(data|bss)(\.[^r]|$$)/ {n += $$2} END {exit n != 0}'

check-build: all ## install into a scratch root and build a program against what is there
	@sh tests/install.sh $(B) $(VARIANT) "$(CC)" "$(FEATURES)"

asan: ## the tests under ASan and UBSan
	@TRUTH_ARGS="--size 160x120" $(MAKE) --no-print-directory VARIANT=asan test

valgrind: $(TESTS) $(B)/gnomon $(SCENES) ## the tests that matter for memory under valgrind
	@sh tests/valgrind.sh $(B)

size: ## bytes per object of the library, built with -Os
	@$(MAKE) --no-print-directory VARIANT=size sizes

sizes: $(B)/libgnomon.a
	@$(CROSS)size -t $<

# Objects of their own, since call graphs are written beside them.
footprint: ## bytes of code, stack and heap for armhf, into docs/footprint.md (debootstrap, qemu)
	@$(MAKE) --no-print-directory CROSS=arm-linux-gnueabihf- VARIANT=footprint FEATURES= measured
	@$(MAKE) --no-print-directory CROSS=arm-linux-gnueabihf- VARIANT=footprint footprint-page

measured: $(B)/libgnomon.a $(B)/tests/bench/bench_memory

footprint-page: measured
	@$(PYTHON) tests/footprint.py $(CROSS) $(B) qemu-arm-static -L $(SYSROOT) > build/footprint.md && mv build/footprint.md docs/footprint.md

install: install-lib $(COMMAND) ## library, headers, gnomon.pc and the command under DESTDIR and PREFIX
	$(if $(COMMAND),install -d $(D)/bin && install -m 755 $(COMMAND) $(D)/bin)

install-lib: $(B)/libgnomon.a ## the same without the command, which alone needs cJSON and libpng
	install -d $(D)/include/gnomon $(D)/lib/pkgconfig
	install -m 644 $(PUBLIC) $(D)/include/gnomon
	install -m 644 $(B)/libgnomon.a $(D)/lib
	sed 's|@PREFIX@|$(PREFIX)|; s|@VERSION@|$(VERSION)|; s|@FEATURES@|$(FEATURES)|' port/gnomon.pc.in > $(D)/lib/pkgconfig/gnomon.pc

format: ## lay out every C file by .clang-format
	clang-format -i $$(git ls-files '*.c' '*.h' | grep -v gl_funcs.h)

deps: ## what is missing here: installs it as root on Debian, else prints the command that does
	@sh tools/deps.sh

clean: ## remove build/
	rm -rf build

help: ## this list
	@awk -F':.*## ' '/^[a-z-]+:.*## / {printf "  %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

$(B)/libgnomon.a: $(LIBRARY)
	@echo "  ar    $@"
	@rm -f $@
	$(Q)$(AR) rcs $@ $^
$(B)/gnomon: $(B)/tools/main.o $(TOOLS) $(B)/libgnomon.a
	@echo "  link  $@"
	$(Q)$(CC) $(SYSTEM) $($(VARIANT)) $(CFLAGS) $(LDFLAGS) $^ $(TOOL_LIBS) -o $@
$(B)/examples/%: $(B)/examples/%.o $(B)/libgnomon.a
	@echo "  link  $@"
	$(Q)$(CC) $(SYSTEM) $($(VARIANT)) $(CFLAGS) $(LDFLAGS) $^ -lEGL -lm -o $@
$(B)/tests/%: $(B)/tests/%.o $(B)/libhosts.a $(B)/libgnomon.a
	@echo "  link  $@"
	$(Q)$(CC) $(SYSTEM) $($(VARIANT)) $(CFLAGS) $(LDFLAGS) $^ $(TEST_LIBS) -o $@
# Of which a test takes what it calls: some have libraries that lack the rest.
$(B)/libhosts.a: $(SUPPORT) $(TOOLS)
	@rm -f $@
	$(Q)$(AR) rcs $@ $^
# Objects are made anew when the compiler or its flags change.
$(B)/flags: force
	@mkdir -p $(@D)
	@echo '$(CC) $(WERROR) $($(VARIANT)) $(CPPFLAGS) $(CFLAGS)' | cmp -s - $@ || \
	  echo '$(CC) $(WERROR) $($(VARIANT)) $(CPPFLAGS) $(CFLAGS)' > $@
$(B)/%.o: %.c $(B)/flags | $(SHADERS)
	@mkdir -p $(@D)
	@echo "  cc    $<"
	$(Q)$(CC) $(FLAGS) -c $< -o $@
# Rules become tables: read where the build runs, by the reader that the library has for others.
build/host/compile_rules: $(COMPILER)
	@mkdir -p $(@D)
	@echo "  host  $@"
	$(Q)$(HOST_CC) -std=c99 -O1 -Iport -Icore $(filter %.c,$^) -lm -o $@
build/host/bake_font: tools/view/bake_font.c
	@mkdir -p $(@D)
	@echo "  host  $@"
	$(Q)$(HOST_CC) -std=c99 -O1 $(shell $(HOST_PKG_CONFIG) --cflags freetype2) $< $(shell $(HOST_PKG_CONFIG) --libs freetype2) -o $@
$(B)/tools/view/font.h: build/host/bake_font $(FONT)
	@mkdir -p $(@D)
	@build/host/bake_font $(FONT) > $@.part && mv $@.part $@
$(B)/rules/%.fcl.h: rules/%.fcl build/host/compile_rules
	@mkdir -p $(@D)
	@build/host/compile_rules < $< > $@.part && mv $@.part $@
build/angle/libEGL.so:
	@sh tests/angle.sh build/angle
# A shader becomes a C string: comments go, lines stay, so that the driver's line numbers are the file's.
$(B)/%.h: %
	@mkdir -p $(@D)
	@{ echo 'static const char gni_shader_$(subst .,_,$(notdir $<))[] ='; \
	  sed 's|[[:space:]]*//.*||; s|^[[:space:]]*||; s|\\|\\\\|g; s|"|\\"|g; s|.*|    "&\\n"|' $<; echo '    ;'; } > $@
$(TOOLS) $(SUPPORT): | $(DRAWN)
ifneq ($(ROOT),)
$(ROOT):
	@echo "  root  $(SYSROOT)"
	@sh tests/arm_root.sh $(ARCH) $(SYSROOT)
$(TOOLS) $(SUPPORT) $(B)/tools/main.o $(addsuffix .o,$(TESTS) $(BENCHES) $(B)/tests/truth/truth_table $(B)/examples/minimal): | $(ROOT)
endif
$(SCENES): $(wildcard tests/scenes/*.py)
	@mkdir -p $(@D)
	$(PYTHON) tests/scenes/scenes.py $(@D)

# `make deps demo` on a bare machine: nothing is built before what builds it is there.
ifneq ($(filter deps,$(MAKECMDGOALS)),)
$(LIBRARY) $(TOOLS) $(SUPPORT) $(SHADERS) $(DRAWN) build/host/compile_rules build/host/bake_font $(FONT) $(SCENES) $(B)/tools/main.o $(addsuffix .o,$(TESTS) $(BENCHES) $(B)/tests/truth/truth_table $(B)/examples/minimal) headers layers check-build: | deps
endif

-include $(shell find $(B) -name '*.d' 2>/dev/null)
