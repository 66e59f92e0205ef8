// Tests how the control channel takes over standard input and output: sockets, pipes and files. In
// each test, descriptors of the test take the places of standard input and output.
#include "app/control/endpoint_private.h"

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static DipEndpoint endpoint;
static DipWire wire;
static DipError err;
static int kept[2]; // the program's own standard input and output

static int keep(void **state) {
    (void)state;
    fflush(stdout);
    kept[0] = dup(STDIN_FILENO);
    kept[1] = dup(STDOUT_FILENO);
    return kept[0] < 0 || kept[1] < 0;
}

static int give_back(void **state) {
    (void)state;
    fflush(stdout);
    dup2(kept[0], STDIN_FILENO);
    dup2(kept[1], STDOUT_FILENO);
    close(kept[0]);
    close(kept[1]);
    return 0;
}

// Lets the endpoint take over these descriptors, which are closed. -1 stands for a closed output.
static bool open_with(int in, int out) {
    assert_true(dup2(in, STDIN_FILENO) == STDIN_FILENO);
    if (out >= 0) {
        assert_true(dup2(out, STDOUT_FILENO) == STDOUT_FILENO);
    } else {
        close(STDOUT_FILENO);
    }
    if (out >= 0 && out != in) {
        close(out);
    }
    close(in);
    err = (DipError){0};
    return dip_endpoint_open_standard(&endpoint, &wire, &err);
}

static bool are_same_file(int a, int b) {
    struct stat x, y;
    assert_true(fstat(a, &x) == 0 && fstat(b, &y) == 0);
    return x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

static void close_all(void) {
    const DipWire open = wire;
    dip_wire_close(&wire);
    assert_true(wire.in == -1 && wire.out == -1);
    if (open.out != open.in) {
        assert_int_equal(fcntl(open.out, F_GETFD), -1);
    }
    if (open.socket) {
        assert_int_equal(fcntl(open.in, F_GETFD), -1);
    }
    dip_endpoint_close(&endpoint);
    assert_int_equal(endpoint.stdout_copy, -1);
}

// Writes until the connection takes no more, and returns the number of bytes.
static size_t fill(void) {
    static const char block[3 << 14]; // The last one fits a pipe of 2^16 bytes in part.
    size_t sum = 0;
    for (ptrdiff_t count; (count = dip_wire_write(&wire, block, sizeof block)) != 0;) {
        assert_true(count > 0);
        sum += (size_t)count;
    }
    return sum;
}

static void drain(int descriptor, size_t bytes) {
    static char block[1 << 16];
    while (bytes > 0) {
        const ssize_t count = read(descriptor, block, sizeof block < bytes ? sizeof block : bytes);
        assert_true(count > 0);
        bytes -= (size_t)count;
    }
}

static void one_socket_serves_both_directions(void **state) {
    (void)state;
    int ends[2];
    char text[16] = "";
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    assert_true(open_with(ends[0], ends[0]));
    assert_true(wire.socket && wire.sends && wire.in == wire.out);
    assert_true(wire.in > STDERR_FILENO); // It outlives changes of the standard descriptors.
    assert_int_equal(dip_wire_read(&wire, text, sizeof text), 0);
    assert_int_equal(write(ends[1], "ask\n", 4), 4);
    assert_int_equal(dip_wire_read(&wire, text, sizeof text), 4);
    assert_memory_equal(text, "ask\n", 4);
    assert_int_equal(dip_wire_write(&wire, "reply\n", 6), 6);
    assert_int_equal(read(ends[1], text, sizeof text), 6);
    assert_memory_equal(text, "reply\n", 6);
    drain(ends[1], fill());
    // The client may send no more and still wait for replies.
    assert_int_equal(shutdown(ends[1], SHUT_WR), 0);
    assert_int_equal(dip_wire_read(&wire, text, sizeof text), -1);
    assert_false(dip_wire_is_cut(&wire));
    assert_int_equal(dip_wire_write(&wire, "reply\n", 6), 6);
    close(ends[1]);
    assert_true(dip_wire_is_cut(&wire));
    assert_int_equal(dip_wire_write(&wire, "reply\n", 6), -1);
    close_all();
}

static void two_sockets_serve_one_direction_each(void **state) {
    (void)state;
    int in[2], out[2];
    char text[16] = "";
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, in), 0);
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, out), 0);
    assert_true(open_with(in[0], out[0]));
    assert_true(!wire.socket && wire.sends && wire.in == STDIN_FILENO && wire.out != wire.in);
    assert_int_equal(write(in[1], "ask\n", 4), 4);
    assert_int_equal(dip_wire_read(&wire, text, sizeof text), 4);
    drain(out[1], fill());
    close(in[1]);
    assert_int_equal(dip_wire_read(&wire, text, sizeof text), -1);
    assert_false(dip_wire_is_cut(&wire));
    close(out[1]);
    assert_true(dip_wire_is_cut(&wire));
    assert_int_equal(dip_wire_write(&wire, "reply\n", 6), -1);
    close_all();
}

// The parent's own descriptor of the pipe stays one whose writes wait.
static void a_pipe_is_opened_again(void **state) {
    (void)state;
    int in[2], out[2];
    char text[16] = "";
    assert_true(pipe(in) == 0 && pipe(out) == 0);
    const int parents = dup(out[1]);
    assert_true(open_with(in[0], out[1]));
    assert_true(!wire.socket && !wire.sends && wire.in == STDIN_FILENO && wire.most_bytes == 0);
    assert_int_equal(fcntl(parents, F_GETFL) & O_NONBLOCK, 0);
    assert_int_not_equal(fcntl(wire.out, F_GETFL) & O_NONBLOCK, 0);
    assert_true(are_same_file(wire.out, parents));
    // What the program prints goes to standard error.
    assert_true(are_same_file(STDOUT_FILENO, STDERR_FILENO));
    assert_int_equal(dip_wire_write(&wire, "reply\n", 6), 6);
    assert_int_equal(read(out[0], text, sizeof text), 6);
    assert_memory_equal(text, "reply\n", 6);
    drain(out[0], fill());
    assert_int_equal(dip_wire_write(&wire, "again\n", 6), 6);
    close(in[1]);
    assert_int_equal(dip_wire_read(&wire, text, sizeof text), -1);
    assert_false(dip_wire_is_cut(&wire));
    close(out[0]);
    assert_true(dip_wire_is_cut(&wire));
    assert_int_equal(dip_wire_write(&wire, "reply\n", 6), -1);
    dip_endpoint_close(&endpoint);
    assert_true(are_same_file(STDOUT_FILENO, parents));
    close(parents);
    dip_wire_close(&wire);
}

static void a_file_takes_everything(void **state) {
    (void)state;
    char name[] = "/tmp/test_endpoint.XXXXXX";
    char text[16] = "";
    int in[2];
    const int file = mkstemp(name);
    assert_true(file >= 0 && pipe(in) == 0);
    const int own = open(name, O_RDONLY);
    assert_true(open_with(in[0], file));
    assert_true(!wire.sends && wire.most_bytes == 0);
    assert_int_equal(dip_wire_write(&wire, "reply\n", 6), 6);
    assert_int_equal(read(own, text, sizeof text), 6);
    assert_memory_equal(text, "reply\n", 6);
    assert_false(dip_wire_is_cut(&wire));
    close_all();
    close(own);
    close(in[1]);
    unlink(name);
}

static void a_closed_output_is_refused(void **state) {
    (void)state;
    int in[2];
    assert_int_equal(pipe(in), 0);
    assert_false(open_with(in[0], -1));
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_string_equal(err.key, "--control");
    assert_string_equal(err.message, "standard output cannot be used: Bad file descriptor");
    assert_true(wire.out == -1 && endpoint.stdout_copy == -1);
    close(in[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(one_socket_serves_both_directions, keep, give_back),
        cmocka_unit_test_setup_teardown(two_sockets_serve_one_direction_each, keep, give_back),
        cmocka_unit_test_setup_teardown(a_pipe_is_opened_again, keep, give_back),
        cmocka_unit_test_setup_teardown(a_file_takes_everything, keep, give_back),
        cmocka_unit_test_setup_teardown(a_closed_output_is_refused, keep, give_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
