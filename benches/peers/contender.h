// What a peer's program is linked of: the table of its functions, by the side that generates it, and `contender.c`.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

// A function of positions `q`, or of sines (in place of `q`) and cosines `c`; the result row by row.
struct contender {
    const char *name;
    int given;
    int outputs;
    void (*call)(const double *q, const double *dq, const double *ddq, const double *c, double *out);
    // For a regressor in other frames than the spec's: its columns times this matrix, of so many columns, are those of ours. Only
    // values that are told pass through it; a call that is timed does not.
    const double *map;
    int columns;
};

extern int joints;
// Ends with a name of 0.
extern struct contender contenders[];
// Before anything is called: where the program is, for one that reads its arm.
void prepare(const char *program);

#ifdef __cplusplus
}
#endif
