// replay.c - records in, answers out, on the host: replay IN OUT.
#include "pil/pil.h"
#include <stdio.h>

int main(int argc, char **argv) {
  FILE *in = argc == 3 ? fopen(argv[1], "rb") : NULL, *out = in ? fopen(argv[2], "wb") : NULL;
  if (!out) {
    fprintf(stderr, "usage: replay IN OUT\n");
    return 2;
  }
  pil_in_t record;
  pil_out_t answer;
  long calls = 0;
  for (; fread(&record, sizeof record, 1, in) == 1; calls++) {
    pil_before(&record);
    pil_call();
    pil_after(&answer);
    if (fwrite(&answer, sizeof answer, 1, out) != 1) return 1;
  }
  printf("%ld calls, %d words each, %ld floats in all\n", calls, pil_words(), calls * pil_floats());
  fclose(in);
  return fclose(out) == 0 ? 0 : 1;
}
