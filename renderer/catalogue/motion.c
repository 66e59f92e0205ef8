// Moves cameras by fractions of a pixel and compares pictures block by block.
#include "renderer/catalogue/motion.h"

#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;
enum { BLOCK_PIXELS = MOTION_BLOCK * MOTION_BLOCK };

const char *const motion_names[MOTION_KINDS] = {"yaw",      "pitch", "roll",
                                                "sideways", "up",    "forward"};

// --- moving -----------------------------------------------------------------------------------

// Sets *product to the rotation b followed by the rotation a. Quaternions are x, y, z, w.
static void multiply(const double a[4], const double b[4], double product[4]) {
    product[0] = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
    product[1] = a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0];
    product[2] = a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3];
    product[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}

static void turn(DipPose *pose, int axis, double angle) {
    double step[4] = {0.0, 0.0, 0.0, dip_cos(0.5 * angle)};
    const double before[4] = {pose->orientation[0], pose->orientation[1], pose->orientation[2],
                              pose->orientation[3]};
    step[axis] = dip_sin(0.5 * angle);
    multiply(before, step, pose->orientation);
}

// Moves along an axis of the camera.
static void shift(DipPose *pose, int axis, double length_m) {
    const double *q = pose->orientation;
    const double conjugate[4] = {-q[0], -q[1], -q[2], q[3]};
    double along[4] = {0.0, 0.0, 0.0, 0.0};
    double half[4];
    double world[4];
    along[axis] = length_m;
    multiply(q, along, half);
    multiply(half, conjugate, world);
    for (int i = 0; i < 3; i++) {
        pose->position_world[i] += world[i];
    }
}

DipPose motion_move(const DipPose *pose, const MotionStep *step) {
    const double pixel = 2.0 * dip_tan(pose->fov_y_deg * pi / 360.0) / step->height;
    const double length_m = step->step_px * pixel * step->distance_m;
    DipPose moved = *pose;
    switch (step->kind) {
    case MOTION_YAW:
        turn(&moved, 1, step->step_px * pixel);
        break;
    case MOTION_PITCH:
        turn(&moved, 0, step->step_px * pixel);
        break;
    case MOTION_ROLL:
        turn(&moved, 2, step->step_px / (0.5 * step->height));
        break;
    case MOTION_SIDEWAYS:
        shift(&moved, 0, length_m);
        break;
    case MOTION_UP:
        shift(&moved, 1, length_m);
        break;
    default:
        shift(&moved, 2, -length_m);
    }
    return moved;
}

// --- comparing --------------------------------------------------------------------------------

// Returns the mean difference of two pixels, given as indices into the pictures' pixels.
static double pixel_change(const StabilityPicture *a, size_t in_a, const StabilityPicture *b,
                           size_t in_b) {
    double sum = 0.0;
    for (size_t c = 0; c < 3; c++) {
        sum += fabs(a->rgb_lin[3 * in_a + c] - b->rgb_lin[3 * in_b + c]);
    }
    return sum / 3.0;
}

static void block_changes(const StabilityPicture *before, const StabilityPicture *after, int x,
                          int y, double changes[BLOCK_PIXELS]) {
    for (int i = 0; i < BLOCK_PIXELS; i++) {
        const int row = y + i / MOTION_BLOCK;
        const size_t pixel = (size_t)row * (size_t)before->width + (size_t)(x + i % MOTION_BLOCK);
        changes[i] = pixel_change(before, pixel, after, pixel);
    }
}

static double mean_of(const double changes[BLOCK_PIXELS]) {
    double sum = 0.0;
    for (int i = 0; i < BLOCK_PIXELS; i++) {
        sum += changes[i];
    }
    return sum / BLOCK_PIXELS;
}

double motion_block_change(const StabilityPicture *before, const StabilityPicture *after, int x,
                           int y) {
    double changes[BLOCK_PIXELS];
    block_changes(before, after, x, y, changes);
    return mean_of(changes);
}

static int descending(const void *a, const void *b) {
    const double difference = *(const double *)b - *(const double *)a;
    return (difference > 0.0) - (difference < 0.0);
}

static void keep_greatest(MotionPeak *peak, double value, int x, int y) {
    if (!(value <= peak->value)) { // A value that is not a number is kept, too.
        *peak = (MotionPeak){value, x, y};
    }
}

static double mean_gradient(const StabilityPicture *picture) {
    double sum = 0.0;
    const size_t width = (size_t)picture->width;
    for (int y = 0; y + 1 < picture->height; y++) {
        for (int x = 0; x + 1 < picture->width; x++) {
            const size_t pixel = (size_t)y * width + (size_t)x;
            sum += pixel_change(picture, pixel, picture, pixel + 1) +
                   pixel_change(picture, pixel, picture, pixel + width);
        }
    }
    return sum / ((double)(picture->width - 1) * (picture->height - 1));
}

MotionChange motion_compare(const StabilityPicture *before, const StabilityPicture *after) {
    MotionChange change = {.gradient = mean_gradient(before)};
    int blocks = 0;
    for (int y = 0; y + MOTION_BLOCK <= before->height; y += MOTION_BLOCK) {
        for (int x = 0; x + MOTION_BLOCK <= before->width; x += MOTION_BLOCK) {
            double changes[BLOCK_PIXELS];
            block_changes(before, after, x, y, changes);
            const double mean = mean_of(changes);
            qsort(changes, BLOCK_PIXELS, sizeof *changes, descending);
            keep_greatest(&change.mean, mean, x, y);
            keep_greatest(&change.broad, changes[BLOCK_PIXELS / 4 - 1], x, y);
            change.picture += mean;
            blocks++;
        }
    }
    change.picture /= blocks;
    return change;
}

// --- searching --------------------------------------------------------------------------------

enum { PARTS = 8, HALVINGS = 5 };

static bool draw_at(const MotionSearch *search, double at_px, StabilityPicture *picture) {
    MotionStep step = search->step;
    step.step_px = at_px;
    const DipPose pose = motion_move(&search->pose, &step);
    return search->draw(search->context, &pose, picture);
}

static void swap(StabilityPicture *a, StabilityPicture *b) {
    const StabilityPicture kept = *a;
    *a = *b;
    *b = kept;
}

// Returns the beginning of the part with the greatest change, or a negative number if drawing
// failed.
static double greatest_part(MotionSearch *search) {
    double at_px = 0.0;
    double greatest = -1.0;
    bool drawn = draw_at(search, 0.0, &search->pictures[0]);
    for (int i = 0; i < PARTS && drawn; i++) {
        drawn = draw_at(search, (i + 1.0) / PARTS, &search->pictures[1]);
        const double value =
            drawn ? motion_compare(&search->pictures[0], &search->pictures[1]).broad.value : 0.0;
        if (value > greatest) {
            greatest = value;
            at_px = (double)i / PARTS;
        }
        swap(&search->pictures[0], &search->pictures[1]);
    }
    return drawn ? at_px : -1.0;
}

bool motion_search(MotionSearch *search, MotionChange *change, double *at_px) {
    StabilityPicture *before = &search->pictures[0];
    StabilityPicture *after = &search->pictures[1];
    StabilityPicture *middle = &search->pictures[2];
    double length_px = 1.0 / PARTS;
    *at_px = greatest_part(search);
    bool drawn = *at_px >= 0.0 && draw_at(search, *at_px, before) &&
                 draw_at(search, *at_px + length_px, after);
    for (int i = 0; i < HALVINGS && drawn; i++) {
        length_px *= 0.5;
        drawn = draw_at(search, *at_px + length_px, middle);
        const bool second = drawn && motion_compare(middle, after).broad.value >
                                         motion_compare(before, middle).broad.value;
        *at_px += second ? length_px : 0.0;
        swap(middle, second ? before : after);
    }
    if (drawn) {
        *change = motion_compare(before, after);
    }
    return drawn;
}
