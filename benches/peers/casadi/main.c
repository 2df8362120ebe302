// Runs one scheme of the study some times over with the right-hand sides that CasADi generated, and prints how long each run took:
//
//     peer proposed|tang_arteaga|slotine_li REPETITIONS [STEPS_PER_MS]
//
// 12 s, by default with steps of 1 ms. The rows printed beside the times are for checking that what was timed is right.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "initial.h"

#ifdef __clang__
static const char versions[] = "CasADi " CASADI_VERSION ", " __VERSION__;
#else
static const char versions[] = "CasADi " CASADI_VERSION ", gcc " __VERSION__;
#endif

#define DURATION_MS 12000
#define MS_PER_ROW 480
#define LARGEST_STATE 256

typedef int right_hand_side(const double** in, double** out, long long* iw, double* w, int mem);
right_hand_side proposed, tang_arteaga, slotine_li;

struct scheme {
    const char* name;
    right_hand_side* rate;
    const double* initial;
    int len;
    // Where theta_hat begins in the state; q and dq come first.
    int theta_hat;
};

#define SCHEME(name, theta_hat) {#name, name, initial_##name, sizeof initial_##name / sizeof(double), theta_hat}
static const struct scheme schemes[] = {SCHEME(proposed, 12), SCHEME(tang_arteaga, 6), SCHEME(slotine_li, 6)};

struct row {
    double time_s, x[LARGEST_STATE];
};

// Paper eq. (24): position, velocity and acceleration.
static void desired_motion(double t, double motion[9]) {
    static const double offset[3] = {0, 90, -90}, amplitude[3][3] = {{5, 5, 2.5}, {15, 3, 2.5}, {10, 2, 3}};
    const double degree = 3.14159265358979323846 / 180;
    const double s1 = sin(t), c1 = cos(t);
    const double s2 = 2 * s1 * c1, c2 = c1 * c1 - s1 * s1;
    const double s3 = s2 * c1 + c2 * s1, c3 = c2 * c1 - s2 * s1;
    for (int i = 0; i < 3; ++i) {
        const double* a = amplitude[i];
        motion[i] = (offset[i] + a[0] * s1 + a[1] * s2 + a[2] * s3) * degree;
        motion[3 + i] = (a[0] * c1 + 2 * a[1] * c2 + 3 * a[2] * c3) * degree;
        motion[6 + i] = -(a[0] * s1 + 4 * a[1] * s2 + 9 * a[2] * s3) * degree;
    }
}

static void evaluate(const struct scheme* scheme, const double* x, const double* desired, double* rate) {
    const double* in[] = {x, desired};
    scheme->rate(in, &rate, NULL, NULL, 0);
}

static void run(const struct scheme* scheme, int steps_per_ms, struct row* rows) {
    const int len = scheme->len;
    const int steps = DURATION_MS * steps_per_ms, steps_per_row = MS_PER_ROW * steps_per_ms;
    const double h = 1e-3 / steps_per_ms;
    double x[LARGEST_STATE], stage[LARGEST_STATE], k1[LARGEST_STATE], k2[LARGEST_STATE], k3[LARGEST_STATE], k4[LARGEST_STATE];
    // A step's end is the next one's start.
    double start[9], middle[9], end[9];
    memcpy(x, scheme->initial, len * sizeof(double));
    desired_motion(0, end);
    for (int n = 0; n < steps; ++n) {
        memcpy(start, end, sizeof start);
        desired_motion((n + 0.5) * h, middle);
        desired_motion((n + 1) * h, end);
        evaluate(scheme, x, start, k1);
        for (int i = 0; i < len; ++i) stage[i] = x[i] + h / 2 * k1[i];
        evaluate(scheme, stage, middle, k2);
        for (int i = 0; i < len; ++i) stage[i] = x[i] + h / 2 * k2[i];
        evaluate(scheme, stage, middle, k3);
        for (int i = 0; i < len; ++i) stage[i] = x[i] + h * k3[i];
        evaluate(scheme, stage, end, k4);
        for (int i = 0; i < len; ++i) x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        if ((n + 1) % steps_per_row == 0) {
            rows->time_s = (n + 1) * h;
            memcpy(rows++->x, x, len * sizeof(double));
        }
    }
}

static double now_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

static void print(const char* name, const double* numbers, int count) {
    printf(", \"%s\": [", name);
    for (int i = 0; i < count; ++i) printf("%s%.17g", i ? ", " : "", numbers[i]);
    printf("]");
}

static void print_row(const struct scheme* scheme, const struct row* row) {
    double desired[9], error[3];
    desired_motion(row->time_s, desired);
    for (int i = 0; i < 3; ++i) error[i] = row->x[i] - desired[i];
    printf("{\"t_s\": %.17g", row->time_s);
    print("q", row->x, 3), print("dq", row->x + 3, 3), print("e", error, 3);
    print("theta_hat", row->x + scheme->theta_hat, 18);
    printf("}");
}

static void time_runs(const struct scheme* scheme, int repetitions, int steps_per_ms) {
    static struct row rows[DURATION_MS / MS_PER_ROW];
    double* seconds = malloc(repetitions * sizeof(double));
    for (int n = 0; n < repetitions; ++n) {
        const double start = now_s();
        run(scheme, steps_per_ms, rows);
        seconds[n] = now_s() - start;
    }
    printf("{\"scheme\": \"%s\", \"steps\": %d, \"with\": \"%s\"", scheme->name,
           DURATION_MS * steps_per_ms, versions);
    print("seconds", seconds, repetitions);
    printf(", \"rows\": [");
    for (int n = 0; n < DURATION_MS / MS_PER_ROW; ++n) {
        printf("%s", n ? ", " : "");
        print_row(scheme, &rows[n]);
    }
    printf("]}\n");
    free(seconds);
}

int main(int count, char** arguments) {
    const int repetitions = count > 2 ? atoi(arguments[2]) : 0;
    const int steps_per_ms = count > 3 ? atoi(arguments[3]) : 1;
    for (int n = 0; n < 3 && repetitions >= 1 && steps_per_ms >= 1; ++n) {
        if (strcmp(arguments[1], schemes[n].name) == 0) {
            time_runs(&schemes[n], repetitions, steps_per_ms);
            return 0;
        }
    }
    fprintf(stderr, "usage: peer proposed|tang_arteaga|slotine_li REPETITIONS [STEPS_PER_MS]\n");
    return 2;
}
