#include <plumbline_tests/support.h>
