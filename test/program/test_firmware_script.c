// test_firmware_script.c - what tools/firmware.sh says if something that it needs is missing.
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

// A folder with those parts of the firmware that the row names.
#define SUBMODULES                                                                                           \
  "mkdir -p $S/f/vendor/CMSIS/CMSIS/Core/Include $S/f/vendor/FreeRTOS $S/f/vendor/libdw1000/inc && "         \
  "touch $S/f/vendor/CMSIS/CMSIS/Core/Include/core_cm4.h $S/f/vendor/FreeRTOS/tasks.c "                      \
  "$S/f/vendor/libdw1000/inc/libdw1000.h && "
#define FIRMWARE                                                                                             \
  "rm -rf $S/f && mkdir -p $S/f/tools/make $S/f/vendor/FreeRTOS && touch $S/f/tools/make/oot.mk && "

TEST(firmware_script_says_in_one_line_what_is_missing_or_not_supported) {
  static const struct {
    const char *line, *want;
  } row[] = {
      {"tools/firmware.sh build /nowhere legacy", "not the Crazyflie firmware, it has no tools/make/oot.mk"},
      {FIRMWARE "tools/firmware.sh build $S/f legacy", "its submodules are missing; type: git -C "},
      {FIRMWARE SUBMODULES "rm $S/f/vendor/FreeRTOS/tasks.c; tools/firmware.sh build $S/f legacy",
       "submodules are missing"},
      {FIRMWARE SUBMODULES "rm -r $S/f/vendor/CMSIS; tools/firmware.sh build $S/f plus",
       "submodules are missing"},
      {FIRMWARE SUBMODULES "rm -r $S/f/vendor/libdw1000; tools/firmware.sh cload $S/f plus",
       "submodules are missing"},
      {"tools/firmware.sh build /nowhere upgrade", "the thrust upgrade kit is not supported"},
      {"tools/firmware.sh build /nowhere brushless", "the Crazyflie Brushless is not supported"},
      {"tools/firmware.sh cload /nowhere ''", "PROPELLERS=: allowed is legacy or plus"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].want);
    char text[1024];
    CHECK(program_run(row[i].line, STREAM_ERROR, text, sizeof text) == 2);
    CHECK(strstr(text, row[i].want) != NULL);
    const char *const end = strchr(text, '\n');
    CHECK(end != NULL && end[1] == '\0');
  }
}
