// Tests the matrices that follow from an object's transform by what they promise: turned normals
// stand upright on turned surfaces, and the inverse takes the transform back.
#include "renderer/catalogue/random.h"
#include "renderer/scene/resources/placement.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "vec.h"

static void apply(const float transform[12], const Vec v, Vec to) {
    for (int r = 0; r < 3; r++) {
        to[r] = 0.0;
        for (int k = 0; k < 3; k++) {
            to[r] += (double)transform[4 * r + k] * v[k];
        }
    }
}

static void random_vector(Random *random, Vec v) {
    for (int i = 0; i < 3; i++) {
        v[i] = random_real(random, -1.0, 1.0);
    }
}

// Returns the determinant of a transform.
static double volume(const float transform[12]) {
    Vec columns[3], product;
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) {
            columns[c][r] = (double)transform[4 * r + c];
        }
    }
    cross(columns[0], columns[1], product);
    return dot(product, columns[2]);
}

static DipSceneObject random_object(Random *random, double size) {
    float transform[12];
    DipSceneObject object = {.mesh = 7};
    do {
        for (int i = 0; i < 12; i++) {
            transform[i] = (float)(size * random_real(random, -1.0, 1.0));
        }
    } while (fabs(volume(transform)) < 0.1 * size * size * size);
    dip_scene_object_place(&object, transform);
    assert_memory_equal(object.transform, transform, sizeof transform);
    assert_int_equal(object.mesh, 7);
    return object;
}

// A turned normal is perpendicular to what its surface becomes, on the side to which the normal
// itself is turned. The greatest element of the matrix is 1 or -1, however large the object is.
static void normals_stand_on_turned_surfaces(void **state) {
    (void)state;
    static const double sizes[] = {1.0, 1e-6, 1e6, 1e-12, 1e12};
    Random random = {1};
    int mirrored = 0;
    for (int i = 0; i < 2000; i++) {
        const DipSceneObject object = random_object(&random, sizes[i % 5]);
        Vec normal, other, along, turned = {0.0, 0.0, 0.0}, moved;
        double greatest = 0.0;
        random_vector(&random, normal);
        random_vector(&random, other);
        cross(normal, other, along);
        for (int k = 0; k < 9; k++) {
            turned[k / 3] += (double)object.normal_to_world[k] * normal[k % 3];
            greatest = fmax(greatest, fabs((double)object.normal_to_world[k]));
        }
        assert_true(greatest == 1.0);
        apply(object.transform, along, moved);
        assert_true(fabs(dot(turned, moved)) <= 1e-5 * length(turned) * length(moved) + 1e-30);
        apply(object.transform, normal, moved);
        assert_true(dot(turned, moved) > 0.0);
        assert_int_equal(object.mirrors, volume(object.transform) < 0.0);
        mirrored += object.mirrors;
    }
    assert_true(mirrored > 500 && mirrored < 1500);
}

static void the_inverse_takes_the_transform_back(void **state) {
    (void)state;
    Random random = {2};
    int inverted = 0;
    for (int i = 0; i < 2000; i++) {
        const DipSceneObject object = random_object(&random, i % 2 ? 1.0 : 1e5);
        bool any = false;
        for (int k = 0; k < 9; k++) {
            any = any || object.world_to_object[k] != 0.0;
        }
        for (int k = 0; any && k < 9; k++) {
            double sum = 0.0;
            for (int j = 0; j < 3; j++) {
                sum +=
                    object.world_to_object[k / 3 * 3 + j] * (double)object.transform[4 * j + k % 3];
            }
            assert_true(fabs(sum - (k / 3 == k % 3)) < 1e-9);
        }
        inverted += any;
    }
    assert_true(inverted > 500);
}

// One axis leans towards the two others by an angle. The inverse is kept if 1 / the sine of the
// angle between an axis and the plane of the others is at most 4.
static void a_nearly_flat_object_has_no_inverse(void **state) {
    (void)state;
    static const double sines[] = {1.0, 0.5, 0.26, 0.2501, 0.2499, 0.1, 1e-3, 0.0};
    for (int axis = 0; axis < 3; axis++) {
        for (int leaning = 0; leaning < 2; leaning++) {
            for (size_t i = 0; i < sizeof sines / sizeof *sines; i++) {
                const int towards = (axis + 1 + leaning) % 3;
                float transform[12] = {0.0f};
                for (int c = 0; c < 3; c++) {
                    transform[4 * c + c] = c == axis ? (float)(3.0 * sines[i]) : 2.0f;
                }
                transform[4 * towards + axis] = (float)(3.0 * sqrt(1.0 - sines[i] * sines[i]));
                DipSceneObject object;
                dip_scene_object_place(&object, transform);
                for (int k = 0; k < 3; k++) {
                    const double element = object.world_to_object[4 * k];
                    assert_int_equal(element != 0.0, sines[i] > 0.25);
                }
            }
        }
    }
}

static void an_object_without_a_size_has_no_matrices(void **state) {
    (void)state;
    static const float none[12] = {[3] = 5.0f, [7] = 6.0f, [11] = 7.0f};
    DipSceneObject object;
    dip_scene_object_place(&object, none);
    assert_false(object.mirrors);
    for (int i = 0; i < 9; i++) {
        assert_true(object.normal_to_world[i] == 0.0f && object.world_to_object[i] == 0.0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_stand_on_turned_surfaces),
        cmocka_unit_test(the_inverse_takes_the_transform_back),
        cmocka_unit_test(a_nearly_flat_object_has_no_inverse),
        cmocka_unit_test(an_object_without_a_size_has_no_matrices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
