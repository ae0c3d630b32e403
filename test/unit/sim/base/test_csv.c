// test_csv.c - CSV files: what is read exactly, and what is refused with which line.
#include "base/csv.h"
#include "base/number.h"
#include "rig/scratch.h"
#include "rig/test.h"

#include <locale.h>
#include <string.h>

// Reads the columns a (no gaps) and b (gaps allowed) to the end; sums what is there and counts gaps.
typedef struct {
  double a, b;
  int rows, gaps;
} sums_t;

static done_t sum(const char *path, sums_t *s, why_t *why) {
  *s = (sums_t){0};
  csv_file_t *file;
  TRY(csv_open(&file, path, why));
  const int a = csv_find(file, "a"), b = csv_find(file, "b");
  bool more = true;
  done_t status = a < 0 || b < 0 ? csv_refuse(file, -1, why, "no a or b") : DONE;
  while (status == DONE && (status = csv_next(file, &more, why)) == DONE && more) {
    double x = 0.0, y = 0.0;
    status = csv_number(file, a, CSV_GAP_REFUSED, &x, why);
    if (status == DONE) status = csv_number(file, b, CSV_GAP_NAN, &y, why);
    s->rows++;
    s->a += x;
    if (isnan(y))
      s->gaps++;
    else
      s->b += y;
  }
  csv_close(file);
  return status;
}

TEST(csv_reads_what_programs_write) {
  static const struct {
    const char *what, *text;
    sums_t want;
  } row[] = {
      {"plain", "a,b\n1,2\n3,4.5\n", {4.0, 6.5, 2, 0}},
      {"no newline at the end", "a,b\n1,2\n3,4", {4.0, 6.0, 2, 0}},
      {"CRLF", "a,b\r\n1,2\r\n3,4\r\n", {4.0, 6.0, 2, 0}},
      {"byte order mark",
       "\xEF\xBB\xBF"
       "a,b\n1,2\n",
       {1.0, 2.0, 1, 0}},
      {"quotes and blanks", "\"a\", b ,\"c\nd\"\n \"1\" , 2 ,3\n", {1.0, 2.0, 1, 0}},
      {"blanks alike with quotes and without",
       "a,b\n 1 ,\t2 \r\n \t\r\n\"1\" ,\t2 \r\n 1,2",
       {3.0, 6.0, 3, 0}},
      {"an empty cell at the end, with quotes and without", "a,b\n1,\n\"1\",\n1, \n", {3.0, 0.0, 3, 3}},
      {"quotes over lines, and none behind them", "a,b,c\n1,2,\"x\n\n3,4\"\n1,2,z\n", {2.0, 4.0, 2, 0}},
      {"blank lines", "\na,b\n\n1,2\n\n\n3,4\n\n", {4.0, 6.0, 2, 0}},
      {"order of columns, text beside", "b,name,a\n2,x,1\n4,y;z,3\n", {4.0, 6.0, 2, 0}},
      {"gaps", "a,b\n1,nan\n2,\n3,NaN\n4,-nan\n5,7\n", {15.0, 7.0, 5, 4}},
      {"exponents and signs", "a,b\n1e-3,+2E2\n-.5,3.\n", {-0.499, 203.0, 2, 0}},
      {"column without a name", "a,b,\n1,2,\n", {1.0, 2.0, 1, 0}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    sums_t s;
    why_t why = {""};
    CHECK_OK(sum(scratch_file("t.csv", row[i].text, -1), &s, &why));
    CHECK_TEXT(why.text, "");
    CHECK(s.rows == row[i].want.rows && s.gaps == row[i].want.gaps);
    CHECK_NEAR(s.a, row[i].want.a, 1e-15);
    CHECK_NEAR(s.b, row[i].want.b, 1e-15);
  }
}

static const struct {
  const char *what, *text, *want;
} refused[] = {
    {"empty", "", "t.csv:1: the file is empty; allowed: a row of names and rows of numbers"},
    {"blank", "\n\n", "t.csv:1: the file is empty; allowed: a row of names and rows of numbers"},
    {"header only", "a,b\n", "t.csv:1: no row under the names; allowed: one or more"},
    {"header cut off", "a,b", "t.csv:1: no row under the names; allowed: one or more"},
    {"last line cut off", "a,b,c\n1,2,3\n1,2",
     "t.csv:3: column c: missing: the row has 2 cells, the first row names 3 (cut off here?)"},
    {"too many cells", "a,b\n1,2\n1,2,3\n",
     "t.csv:3: 3 cells where the first row names 2; allowed: `,` between cells and `.` in numbers"},
    {"text", "a,b\n1,2\n\n1,x\n",
     "t.csv:4: column b: not a number: `x`; allowed: a number, or nan or nothing for a gap"},
    {"text, no gaps", "a,b\none,2\n", "t.csv:2: column a: not a number: `one`; allowed: a number"},
    {"gap", "a,b\n1,2\nnan,2\n", "t.csv:3: column a: a gap; allowed: a number"},
    {"infinite", "a,b\n1e999,2\n", "t.csv:2: column a: not finite: `1e999`; allowed: a number"},
    {"inf", "a,b\n1,inf\n",
     "t.csv:2: column b: not a number: `inf`; allowed: a number, or nan or nothing for a gap"},
    {"hexadecimal", "a,b\n0x10,2\n", "t.csv:2: column a: not a number: `0x10`; allowed: a number"},
    {"half a number", "a,b\n1-2,2\n", "t.csv:2: column a: not a number: `1-2`; allowed: a number"},
    {"decimal comma", "a,b\n\"0,5\",2\n", "t.csv:2: column a: decimal comma in `0,5`; allowed: `.`"},
    {"semicolons", "a;b\n0,5;2\n",
     "t.csv:1: the separator is `;`; allowed: `,` between cells and `.` in numbers"},
    {"tabs", "a\tb\n1\t2\n",
     "t.csv:1: the separator is a tab; allowed: `,` between cells and `.` in numbers"},
    {"name twice", "a,b,a\n1,2,3\n",
     "t.csv:1: column a: the name stands twice, in cells 1 and 3; allowed: once"},
    {"no names", "0.5,1\n1,2\n", "t.csv:1: cell 1 is the number 0.5; allowed: the first row holds the names"},
    {"open quote", "a,b\n1,\"2\n3,4\n", "t.csv:3: a quote that does not end or stands inside a cell"},
    {"control characters", "a,b\n\x1b[2J,2\n", "t.csv:2: column a: not a number: `?[2J`; allowed: a number"},
};

TEST(csv_refuses_with_file_line_and_column) {
  for (unsigned i = 0; i < sizeof refused / sizeof *refused; i++) {
    ROW("%s", refused[i].what);
    sums_t s;
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, sum(scratch_file("t.csv", refused[i].text, -1), &s, &why));
    CHECK_TEXT(scratch_short(why.text), refused[i].want);
  }
}

TEST(csv_refuses_what_is_no_file_or_no_text) {
  sums_t s;
  why_t why;
  CHECK_STATUS(BAD_INPUT, sum(scratch_path("none.csv"), &s, &why));
  CHECK_TEXT(scratch_short(why.text), "none.csv: cannot be opened: No such file or directory");
  CHECK_STATUS(BAD_INPUT, sum(scratch_path("."), &s, &why));
  CHECK_TEXT(scratch_short(why.text), ".: cannot be read: Is a directory");
  CHECK_STATUS(BAD_INPUT, sum(scratch_file("t.bin", "a,b\n1,2\0\n", 9), &s, &why));
  CHECK_TEXT(scratch_short(why.text), "t.bin:2: not a text file; allowed: CSV");
  static char line[CSV_LINE_MAX + 100];
  memset(line, 'a', sizeof line - 1);
  CHECK_STATUS(BAD_INPUT, sum(scratch_file("t.csv", line, -1), &s, &why));
  CHECK_TEXT(scratch_short(why.text), "t.csv:1: the line is too long; allowed: 32768 bytes");
}

TEST(number_means_the_same_in_every_locale) {
  // Not every machine has a locale with a comma; where there is none this says nothing.
  const char *comma = setlocale(LC_ALL, "de_DE.UTF-8");
  double x = 0.0;
  CHECK(number_parse("1.5", &x));
  CHECK_NEAR(x, 1.5, 0.0);
  CHECK(!number_parse("1,5", &x) && !number_parse("", &x) && !number_parse(" 1", &x) &&
        !number_parse("1 ", &x));
  CHECK(!number_parse("nan", &x) && !number_parse("e", &x) && !number_parse("--1", &x));
  if (comma) setlocale(LC_ALL, "C");
}
