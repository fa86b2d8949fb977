/* @{banner}
   Prints what some functions give at a fixed configuration: joints at 0.1, 0.2, ... (rad or m), a floating base at the origin, rates and
   accelerations at 0.01, 0.02, ... */

#include <stdio.h>

#include "cga_@{robot}.h"

static void print(const char *title, int rows, int cols, const double *x)
{
    printf("%s\n", title);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < cols; ++j)
            printf(" %.17g", x[cols * i + j]);
        printf("\n");
    }
}

int main(void)
{
    int bad = 0;
@{steps}    return bad;
}
