#include "tests/support/shell_statics.h"
int main(void) { return 0; }
