# lanes.sed - from C to C++ for eight vehicles at a time (sim/base/lane_c.hpp): what C++'s own numbers count, an enum that is
# eight, members that C++ wants in no nameless struct, and headers of the system, which are there already.
s/#include <[^>]*>//g
s/\bfor \(int /for (plain_int /g
s/\bfor \(unsigned /for (plain_unsigned /g
s/typedef enum \{([^{}]*)\} ([A-Za-z0-9_]+);/enum \2_plain {\1};typedef lane_kind_t<\2_plain> \2;/g
s/\n +(struct|union) \{([^{}]*)\n +\};/\2/g
s/\n +(struct|union) \{([^{}]*)\n +\};/\2/g
