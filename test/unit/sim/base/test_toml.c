// test_toml.c - TOML files: what is read, and what is refused with which line.
#include "base/toml.h"
#include "rig/scratch.h"
#include "rig/test.h"

static const char VALUES[] =
    "s = \"text\"\nx = 2\ny = 0.5\nb = true\nl = [1, 2.5]\n[t]\nk = 1\n[[a]]\nn = 1\n[[a]]\nn = 2\n";

static const char *const KEYS[] = {"a", "b", NULL};
static const toml_kind_t KIND = {"a test file", "none.toml", KEYS};

TEST(toml_reads_values) {
  toml_file_t *file;
  why_t why;
  if (!CHECK_OK(toml_open(&file, scratch_file("t.toml", VALUES, -1), &KIND, &why))) return;
  const toml_t root = toml_root(file);
  char s[8];
  double x, list[3];
  int n;
  bool b, more;
  toml_t sub;
  CHECK_OK(toml_string(root, "s", s, sizeof s, &why));
  CHECK_TEXT(s, "text");
  CHECK_OK(toml_double(root, "x", 0.0, 3.0, &x, &why));
  CHECK_NEAR(x, 2.0, 0.0);
  CHECK_OK(toml_bool(root, "b", &b, &why));
  CHECK(b);
  CHECK_OK(toml_doubles(root, "l", 3, list, &n, &why));
  CHECK(n == 2);
  CHECK_NEAR(list[1], 2.5, 0.0);
  CHECK_OK(toml_table(root, "t", &sub, &why));
  CHECK(toml_has(sub, "k") && !toml_has(sub, "s"));
  CHECK_OK(toml_table_at(root, "a", 1, &sub, &more, &why));
  CHECK(more);
  CHECK_OK(toml_double(sub, "n", 0.0, 9.0, &x, &why));
  CHECK_NEAR(x, 2.0, 0.0);
  CHECK_OK(toml_table_at(root, "a", 2, &sub, &more, &why));
  CHECK(!more);
  toml_close(file);
}

TEST(toml_refuses_other_types_and_ranges) {
  toml_file_t *file;
  why_t why;
  if (!CHECK_OK(toml_open(&file, scratch_file("t.toml", VALUES, -1), &KIND, &why))) return;
  const toml_t root = toml_root(file);
  char s[8];
  double x, list[3];
  int n;
  bool more;
  toml_t sub;
  CHECK_STATUS(BAD_INPUT, toml_double(root, "s", 0.0, 1.0, &x, &why));
  CHECK_TEXT(scratch_short(why.text), "t.toml:1: s: wrong type; allowed: a number");
  CHECK_STATUS(BAD_INPUT, toml_double(root, "y", 1.0, 2.0, &x, &why));
  CHECK_TEXT(scratch_short(why.text), "t.toml:3: y: 0.5 is out of range; allowed: 1 to 2");
  CHECK_STATUS(BAD_INPUT, toml_doubles(root, "l", 1, list, &n, &why));
  CHECK_TEXT(scratch_short(why.text), "t.toml:5: l: 2 numbers; allowed: at most 1");
  CHECK_STATUS(BAD_INPUT, toml_string(root, "none", s, sizeof s, &why));
  CHECK_TEXT(scratch_short(why.text), "t.toml:1: none: missing; allowed: a text in quotes");
  CHECK_STATUS(BAD_INPUT, toml_string(root, "s", s, 4, &why));
  CHECK_TEXT(scratch_short(why.text), "t.toml:1: s: the text is too long; allowed: 3 bytes");
  CHECK_STATUS(BAD_INPUT, toml_table_at(root, "x", 0, &sub, &more, &why));
  CHECK_TEXT(scratch_short(why.text), "t.toml:2: x: wrong type; allowed: tables, each under [[...]]");
  toml_close(file);
}

TEST(toml_refuses_what_is_no_file) {
  toml_file_t *file;
  why_t why;
  CHECK_STATUS(BAD_INPUT, toml_open(&file, scratch_path("none.toml"), &KIND, &why));
  CHECK_TEXT(scratch_short(why.text), "none.toml: cannot be opened: No such file or directory");
  CHECK_STATUS(BAD_INPUT, toml_open(&file, scratch_path("."), &KIND, &why));
  CHECK_TEXT(scratch_short(why.text), ".: cannot be read: Is a directory");
}
