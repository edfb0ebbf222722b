// Holds states and the clock for a peer's functions: see `benches/src/program.rs` for what is asked and answered. The twin of
// `benches/ours/src/contender.rs`: same states, same blocks, calls through a pointer.
#include "contender.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BLOCK = 500 };

static double *states, *trigonometry;
static size_t count;
static _Alignas(64) double out[8192];

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static void read_states(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        exit(1);
    }
    fseek(file, 0, SEEK_END);
    size_t numbers = (size_t)ftell(file) / sizeof(double), n = (size_t)joints;
    rewind(file);
    count = numbers / (3 * n);
    states = malloc(numbers * sizeof(double));
    trigonometry = malloc(count * 2 * n * sizeof(double));
    if (fread(states, sizeof(double), numbers, file) != numbers) exit(1);
    fclose(file);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < n; k++) {
            trigonometry[2 * n * i + k] = sin(states[3 * n * i + k]);
            trigonometry[2 * n * i + n + k] = cos(states[3 * n * i + k]);
        }
}

static void call(const struct contender *f, size_t i) {
    size_t n = (size_t)joints;
    const double *state = states + 3 * n * i, *t = trigonometry + 2 * n * i;
    f->call(f->given ? t : state, state + n, state + 2 * n, t + n, out);
    // The result is read by somebody.
    __asm__ volatile("" : : "r"(out) : "memory");
}

static double block(const struct contender *f, size_t first) {
    double start = now();
    for (size_t i = first; i < first + BLOCK; i++) call(f, i);
    return (now() - start) / BLOCK;
}

static void tell(const struct contender *f) {
    if (!f->map) {
        for (int k = 0; k < f->outputs; k++) printf("%.17g ", out[k]);
    } else {
        int own = f->outputs / joints;
        for (int row = 0; row < joints; row++)
            for (int column = 0; column < f->columns; column++) {
                double entry = 0;
                for (int k = 0; k < own; k++) entry += out[own * row + k] * f->map[f->columns * k + column];
                printf("%.17g ", entry);
            }
    }
    printf("\n");
}

int main(int argc, char **argv) {
    if (argc < 2) return 2;
    prepare(argv[0]);
    read_states(argv[1]);
    char verb[64], name[64];
    while (scanf("%63s %63s", verb, name) == 2) {
        size_t wanted = 0;
        int is_values = !strcmp(verb, "values");
        if (is_values && scanf("%zu", &wanted) != 1) return 2;
        const struct contender *f = contenders;
        while (f->name && strcmp(f->name, name)) f++;
        if (!f->name) {
            printf("no case `%s`\n", name);
        } else if (is_values) {
            for (size_t i = 0; i < wanted; i++) {
                call(f, i);
                tell(f);
            }
        } else {
            // One block to wake up.
            block(f, 0);
            for (size_t i = 0; i + BLOCK <= count; i += BLOCK) printf("%.4f ", block(f, i));
            printf("\n");
        }
        fflush(stdout);
    }
    return 0;
}
