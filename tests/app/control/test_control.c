// Tests of the control channel with a target that only records requests. Clients connect to a
// socket in a folder of the test, or use standard input and output.
#include "app/control/control.h"
#include "tests/app/control/line_client.h"
#include "tests/app/control/random_lines.h"

#include <cjson/cJSON.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

// --- the fixture ---------------------------------------------------------------------------------

static struct {
    int count;              // Requests carried out.
    int refused;            // Requests refused.
    int puts_off;           // The next requests are put off this often.
    DipControlRequest last; // The last request.
    int last_attempt;
} seen;

static char folder[64];
static char path[96];
static DipControl *control;
static LineClient client;
static LineClient other;

// Refuses paths of the categories "NONE" and "FILE" and carries out everything else.
static DipControlAnswer carry_out(void *context, const DipControlRequest *request, int attempt,
                                  cJSON *reply, DipError *err) {
    (void)context;
    if (attempt < seen.puts_off) {
        return DIP_CONTROL_LATER;
    }
    seen.last = *request;
    seen.last_attempt = attempt;
    if (request->verb == DIP_CONTROL_PATH && strcmp(request->category, "NONE") == 0) {
        ++seen.refused;
        dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "category", "'\xff NONE' is refused");
        return DIP_CONTROL_REFUSED;
    }
    if (request->verb == DIP_CONTROL_PATH && strcmp(request->category, "FILE") == 0) {
        ++seen.refused;
        dip_error_set(err, DIP_ERROR_MISSING, "a\xff.pth", 0, "category", "cannot be opened");
        return DIP_CONTROL_REFUSED;
    }
    ++seen.count;
    cJSON_AddNumberToObject(reply, "count", seen.count);
    return DIP_CONTROL_DONE;
}

static DipControlDef make_def(const char *where) {
    return (DipControlDef){
        .where = where,
        .version = "1.2.3",
        .carry_out = carry_out,
    };
}

static int set_up(void **state) {
    (void)state;
    memset(&seen, 0, sizeof seen);
    strcpy(folder, "/tmp/test_control.XXXXXX");
    if (!mkdtemp(folder)) {
        return -1;
    }
    snprintf(path, sizeof path, "%s/socket", folder);
    const DipControlDef def = make_def(path);
    control = dip_control_open(&def, NULL);
    client.descriptor = other.descriptor = -1;
    return control ? 0 : -1;
}

static int tear_down(void **state) {
    (void)state;
    if (client.descriptor >= 0) {
        line_client_close(&client);
    }
    if (other.descriptor >= 0) {
        line_client_close(&other);
    }
    dip_control_close(&control);
    unlink(path);
    return rmdir(folder); // Fails if the socket's file is left.
}

static const char *take(LineClient *from) {
    const char *line;
    for (int i = 0; i < 4; ++i) {
        if (line_client_take(from, &line)) {
            return line;
        }
        dip_control_poll(control);
    }
    return "nothing";
}

static void connect_client(LineClient *to) {
    line_client_open(to, path);
    assert_string_equal(take(to), "{\"diptych\":\"1.2.3\",\"protocol\":1,\"max_line_bytes\":65536,"
                                  "\"requests\":[\"set\",\"apply\","
                                  "\"path\",\"animation\",\"pause\",\"play\",\"seek\",\"scene\","
                                  "\"size\",\"panel\",\"subscribe\","
                                  "\"unsubscribe\",\"pick\",\"get\",\"screenshot\",\"quit\"],"
                                  "\"topics\":[\"times\",\"errors\","
                                  "\"settings\",\"prices\",\"picks\",\"notices\",\"polls\"]}");
}

static const char *ask(const char *line) {
    line_client_line(&client, line);
    return take(&client);
}

static void assert_nothing(LineClient *from) {
    const char *line;
    dip_control_poll(control);
    assert_false(line_client_take(from, &line));
}

// --- requests and replies ------------------------------------------------------------------------

static void every_line_gets_one_reply_in_order(void **state) {
    (void)state;
    connect_client(&client);
    line_client_line(&client, "{\"id\":1,\"request\":\"apply\"}\n\n{\"id\":2}");
    assert_string_equal(take(&client), "{\"id\":1,\"ok\":true,\"count\":1}");
    assert_non_null(strstr(take(&client), "{\"id\":null,\"ok\":false,\"error\":{\"code\":"
                                          "\"MISSING\",\"field\":\"line\""));
    assert_non_null(strstr(take(&client), "{\"id\":2,\"ok\":false,\"error\":{\"code\":"
                                          "\"MISSING\",\"field\":\"request\""));
    assert_nothing(&client);
    assert_int_equal(seen.count, 1);
    assert_string_equal(ask("{\"id\":9007199254740991,\"request\":\"play\"}"),
                        "{\"id\":9007199254740991,\"ok\":true,\"count\":2}");
    assert_string_equal(ask("{\"id\":\"\\\"\xe2\x82\xac\",\"request\":\"play\"}"),
                        "{\"id\":\"\\\"\xe2\x82\xac\",\"ok\":true,\"count\":3}");
}

// The error of the target holds a byte that is not UTF-8.
static void refusals_of_the_target_are_errors_in_utf8(void **state) {
    (void)state;
    connect_client(&client);
    assert_string_equal(ask("{\"id\":5,\"request\":\"path\",\"category\":\"NONE\"}"),
                        "{\"id\":5,\"ok\":false,\"error\":{\"code\":\"UNKNOWN\",\"field\":"
                        "\"category\",\"message\":\"'? NONE' is refused\"}}");
    assert_string_equal(ask("{\"id\":6,\"request\":\"path\",\"category\":\"FILE\"}"),
                        "{\"id\":6,\"ok\":false,\"error\":{\"code\":\"MISSING\",\"field\":"
                        "\"category\",\"message\":\"cannot be opened\",\"file\":\"a?.pth\"}}");
}

static void lines_may_arrive_in_pieces(void **state) {
    (void)state;
    static const char line[] = "{\"id\":3,\"request\":\"path\",\"category\":\"\xc3\x84\"}\r\n";
    connect_client(&client);
    for (size_t i = 0; i < sizeof line - 1; ++i) {
        assert_nothing(&client);
        assert_int_equal(line_client_send(&client, line + i, 1), 1);
    }
    assert_string_equal(take(&client), "{\"id\":3,\"ok\":true,\"count\":1}");
    assert_string_equal(seen.last.category, "\xc3\x84");
}

// A line of 200 KiB gets one reply, and the next line is read as usual.
static void long_lines_are_refused_once(void **state) {
    (void)state;
    static char bytes[200 * 1024];
    memset(bytes, 'x', sizeof bytes);
    connect_client(&client);
    for (int round = 0; round < 2; ++round) {
        for (size_t sent = 0; sent < sizeof bytes;) {
            sent += line_client_send(&client, bytes + sent, sizeof bytes - sent);
            dip_control_poll(control);
        }
        line_client_line(&client, "\n{\"id\":1,\"request\":\"apply\"}");
        assert_non_null(strstr(take(&client), "\"code\":\"OVERSIZED\",\"field\":\"line\""));
        assert_non_null(strstr(take(&client), "\"id\":1,\"ok\":true"));
        assert_nothing(&client);
    }
}

static void a_request_that_is_put_off_holds_up_the_next_ones(void **state) {
    (void)state;
    connect_client(&client);
    seen.puts_off = 2;
    line_client_line(&client, "{\"id\":1,\"request\":\"get\"}\n{\"id\":2,\"request\":\"get\"}");
    assert_nothing(&client);
    assert_nothing(&client);
    dip_control_poll(control);
    assert_int_equal(seen.last_attempt, 2);
    assert_non_null(strstr(take(&client), "\"id\":1"));
    assert_non_null(strstr(take(&client), "\"id\":2"));
    assert_int_equal(seen.count, 2);
}

// A client may send its requests and close its side before it reads. The last line needs no line
// feed.
static void a_closed_input_is_answered_before_the_connection_closes(void **state) {
    (void)state;
    connect_client(&client);
    line_client_line(&client, "{\"id\":1,\"request\":\"apply\"}");
    line_client_send(&client, "{\"id\":2,\"request\":\"quit\"}", 25);
    shutdown(client.descriptor, SHUT_WR);
    dip_control_poll(control);
    assert_non_null(strstr(take(&client), "\"id\":1,\"ok\":true"));
    assert_non_null(strstr(take(&client), "\"id\":2,\"ok\":true"));
    dip_control_poll(control);
    assert_true(line_client_is_closed(&client));
}

static void a_client_that_leaves_at_once_is_still_obeyed(void **state) {
    (void)state;
    line_client_open(&client, path);
    line_client_line(&client, "{\"request\":\"apply\"}\n{\"request\":\"quit\"}");
    line_client_close(&client);
    dip_control_poll(control);
    dip_control_poll(control);
    assert_int_equal(seen.count, 2);
    assert_int_equal(seen.last.verb, DIP_CONTROL_QUIT);
}

// --- events --------------------------------------------------------------------------------------

static void send_notice(int number) {
    cJSON *fields = cJSON_CreateObject();
    cJSON_AddNumberToObject(fields, "number", number);
    dip_control_send(control, DIP_CONTROL_TOPIC_NOTICES, fields);
}

static void events_reach_their_subscribers(void **state) {
    (void)state;
    connect_client(&client);
    connect_client(&other);
    assert_int_equal(dip_control_topics(control), 0);
    const unsigned before = dip_control_subscriptions(control);
    assert_string_equal(ask("{\"request\":\"subscribe\",\"to\":[\"notices\",\"picks\"]}"),
                        "{\"id\":null,\"ok\":true,\"to\":[\"picks\",\"notices\"]}");
    assert_int_equal(dip_control_topics(control),
                     1u << DIP_CONTROL_TOPIC_NOTICES | 1u << DIP_CONTROL_TOPIC_PICKS);
    assert_int_not_equal(dip_control_subscriptions(control), before);
    send_notice(1);
    assert_string_equal(take(&client), "{\"event\":\"notices\",\"number\":1}");
    assert_nothing(&other);
    assert_string_equal(ask("{\"request\":\"unsubscribe\",\"to\":\"notices\"}"),
                        "{\"id\":null,\"ok\":true,\"to\":[\"picks\"]}");
    send_notice(2);
    assert_nothing(&client);
    assert_int_equal(dip_control_topics(control), 1u << DIP_CONTROL_TOPIC_PICKS);
    assert_int_equal(seen.count, 0);
}

// A client that does not read misses events. It learns how many when it reads again, and then gets
// the newest one.
static void a_slow_reader_misses_events_and_is_told(void **state) {
    (void)state;
    enum { EVENTS = 100000 };
    connect_client(&client);
    ask("{\"request\":\"subscribe\",\"to\":\"notices\"}");
    for (int i = 0; i < EVENTS; ++i) {
        send_notice(i);
    }
    long got = 0, dropped = 0, last = -1;
    for (int round = 0; round < 3; ++round) {
        const char *line;
        while (dip_control_poll(control), line_client_take(&client, &line)) {
            const char *missed = strstr(line, "\"dropped\":");
            dropped += missed ? atol(missed + 10) : 0;
            const long number = atol(strstr(line, "\"number\":") + 9);
            assert_true(number > last);
            assert_int_equal(number, got + dropped);
            last = number;
            ++got;
        }
        if (round == 0) {
            assert_in_range(got, 1000, EVENTS - 1);
            send_notice(EVENTS);
        }
    }
    assert_int_equal(got + dropped, EVENTS + 1);
    assert_int_equal(last, EVENTS);
}

// Requests of a client that does not read its replies wait. None of the replies is lost.
static void requests_wait_for_a_slow_reader(void **state) {
    (void)state;
    enum { LINES = 20000 };
    static const char line[] = "{\"request\":\"get\"}\n";
    connect_client(&client);
    size_t sent = 0, total = LINES * (sizeof line - 1);
    int replies = 0, answered_unread = 0;
    while (sent < total) {
        char bytes[sizeof line * 64];
        size_t count = 0;
        while (count < sizeof line * 60 && sent + count < total) {
            bytes[count] = line[(sent + count) % (sizeof line - 1)];
            ++count;
        }
        const size_t now = line_client_send(&client, bytes, count);
        sent += now;
        dip_control_poll(control);
        const char *reply;
        if (now == 0) { // The socket is full.
            answered_unread = answered_unread ? answered_unread : seen.count;
            replies += line_client_take(&client, &reply);
        }
    }
    assert_in_range(answered_unread, 1, LINES - 1);
    const char *reply;
    while (dip_control_poll(control), line_client_take(&client, &reply)) {
        ++replies;
    }
    assert_int_equal(replies, LINES);
    assert_int_equal(seen.count, LINES);
}

// --- clients and the socket ----------------------------------------------------------------------

static void clients_beyond_the_limit_are_told(void **state) {
    (void)state;
    static LineClient clients[DIP_CONTROL_MAX_CLIENTS];
    for (int c = 0; c < DIP_CONTROL_MAX_CLIENTS; ++c) {
        connect_client(&clients[c]);
    }
    line_client_open(&other, path);
    assert_non_null(strstr(take(&other), "\"code\":\"BUSY\""));
    assert_true(line_client_is_closed(&other));
    line_client_close(&other);
    line_client_close(&clients[3]);
    dip_control_poll(control);
    connect_client(&clients[3]);
    for (int c = 0; c < DIP_CONTROL_MAX_CLIENTS; ++c) {
        line_client_close(&clients[c]);
    }
}

static void only_this_user_can_connect(void **state) {
    (void)state;
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(status.st_mode & 077, 0);
}

static DipErrorCode open_code(const char *where) {
    const DipControlDef def = make_def(where);
    DipError err = {0};
    DipControl *second = dip_control_open(&def, &err);
    dip_control_close(&second);
    return err.code;
}

// Makes a socket with this file, and lets it listen with the shortest queue if `listens`.
static int listen_at(const char *file, bool listens) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(strlen(file) < sizeof address.sun_path);
    strcpy(address.sun_path, file);
    assert_int_equal(bind(listener, (const struct sockaddr *)&address, sizeof address), 0);
    assert_true(!listens || listen(listener, 0) == 0);
    return listener;
}

static void only_a_stale_socket_is_replaced(void **state) {
    (void)state;
    char file[128];
    // Somebody listens.
    assert_int_equal(open_code(path), DIP_ERROR_CONFLICT);
    connect_client(&client);
    // Somebody listens and accepts nobody, and no further client may wait.
    snprintf(file, sizeof file, "%s/busy", folder);
    const int busy = listen_at(file, true), waiting = socket(AF_UNIX, SOCK_STREAM, 0);
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    strcpy(address.sun_path, file);
    assert_int_equal(connect(waiting, (const struct sockaddr *)&address, sizeof address), 0);
    assert_int_equal(open_code(file), DIP_ERROR_CONFLICT);
    close(waiting);
    close(busy);
    unlink(file);
    // Nobody listens any more.
    snprintf(file, sizeof file, "%s/stale", folder);
    close(listen_at(file, false));
    assert_int_equal(open_code(file), DIP_ERROR_NONE);
    assert_int_not_equal(access(file, F_OK), 0);
    // Another file.
    FILE *text = fopen(file, "w");
    fputs("precious", text);
    fclose(text);
    assert_int_equal(open_code(file), DIP_ERROR_CONFLICT);
    struct stat status;
    assert_int_equal(stat(file, &status), 0);
    assert_int_equal(status.st_size, 8);
    // A link to a socket that nobody listens on is not followed.
    unlink(file);
    assert_int_equal(symlink("nowhere", file), 0);
    assert_int_equal(open_code(file), DIP_ERROR_CONFLICT);
    unlink(file);
    assert_int_equal(open_code("/nowhere/at/all"), DIP_ERROR_IO);
    assert_int_equal(open_code(""), DIP_ERROR_OVERSIZED);
    char longest[200];
    memset(longest, 'a', sizeof longest);
    longest[199] = '\0';
    assert_int_equal(open_code(longest), DIP_ERROR_OVERSIZED);
}

// If someone has put another file in the socket's place, closing leaves that file.
static void closing_removes_only_its_own_socket(void **state) {
    (void)state;
    assert_int_equal(unlink(path), 0);
    fclose(fopen(path, "w"));
    dip_control_close(&control);
    assert_int_equal(access(path, F_OK), 0);
    assert_int_equal(unlink(path), 0);
}

// --- standard input and output -------------------------------------------------------------------

// Standard output carries replies only; what the program prints goes to standard error.
static void standard_streams_carry_the_protocol(void **state) {
    (void)state;
    int in[2], out[2];
    const int stdin_before = dup(STDIN_FILENO), stdout_before = dup(STDOUT_FILENO);
    fflush(stdout);
    assert_true(pipe(in) == 0 && pipe(out) == 0);
    dup2(in[0], STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    const DipControlDef def = make_def("-");
    DipError err = {0};
    DipControl *standard = dip_control_open(&def, &err);
    const char requests[] = "{\"id\":1,\"request\":\"apply\"}\n";
    const bool sent = write(in[1], requests, sizeof requests - 1) == sizeof requests - 1;
    if (standard) {
        printf("\n");
        fflush(stdout);
        dip_control_poll(standard);
    }
    dip_control_close(&standard);
    printf("after");
    fflush(stdout);
    dup2(stdin_before, STDIN_FILENO);
    dup2(stdout_before, STDOUT_FILENO);
    close(in[0]), close(in[1]), close(out[1]), close(stdin_before), close(stdout_before);
    char text[4096];
    const ssize_t count = read(out[0], text, sizeof text - 1);
    close(out[0]);
    assert_int_equal(err.code, DIP_ERROR_NONE);
    assert_true(sent && count > 0);
    text[count] = '\0';
    assert_int_equal(strncmp(text, "{\"diptych\":", 11), 0);
    assert_string_equal(strchr(text, '\n'), "\n{\"id\":1,\"ok\":true,\"count\":1}\nafter");
}

// Nobody reads standard output, and the pipe is full: polling must not wait. The long events do not
// fit into what is left of the pipe when it is almost full.
static void a_full_pipe_does_not_hold_up_the_program(void **state) {
    (void)state;
    int in[2], out[2];
    const int stdin_before = dup(STDIN_FILENO), stdout_before = dup(STDOUT_FILENO);
    fflush(stdout);
    assert_true(pipe(in) == 0 && pipe(out) == 0);
    dup2(in[0], STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    const DipControlDef def = make_def("-");
    DipControl *standard = dip_control_open(&def, NULL);
    static const char requests[] = "{\"request\":\"subscribe\",\"to\":\"notices\"}\n";
    bool sent = standard && write(in[1], requests, sizeof requests - 1) > 0;
    static char long_text[20001];
    memset(long_text, 'x', sizeof long_text - 1);
    for (int i = 0; i < 100000 && sent; ++i) {
        cJSON *fields = cJSON_CreateObject();
        cJSON_AddStringToObject(fields, "text", i < 100 ? long_text : "an event that nobody reads");
        dip_control_poll(standard);
        dip_control_send(standard, DIP_CONTROL_TOPIC_NOTICES, fields);
    }
    close(in[1]);  // The client has ended.
    close(out[0]); // Writing would raise SIGPIPE.
    dip_control_poll(standard);
    dip_control_poll(standard);
    const unsigned topics = dip_control_topics(standard);
    dip_control_close(&standard);
    dup2(stdin_before, STDIN_FILENO);
    dup2(stdout_before, STDOUT_FILENO);
    close(in[0]), close(out[1]), close(stdin_before), close(stdout_before);
    assert_true(sent);
    assert_int_equal(topics, 0);
}

// Sends long events to standard output, which nobody reads. Ends the process after 20 s if a write
// waits.
static void flood_standard_output(void) {
    static char long_text[20001];
    const DipControlDef def = make_def("-");
    memset(long_text, 'x', sizeof long_text - 1);
    alarm(20);
    DipControl *standard = dip_control_open(&def, NULL);
    for (int i = 0; i < 100 && standard; ++i) {
        cJSON *fields = cJSON_CreateObject();
        cJSON_AddStringToObject(fields, "text", long_text);
        dip_control_poll(standard);
        dip_control_send(standard, DIP_CONTROL_TOPIC_NOTICES, fields);
    }
    _exit(standard && dip_control_topics(standard) ? 0 : 1);
}

// A pipe without permissions cannot be opened again. Root may open it all the same, so the process
// becomes another user.
static void a_pipe_that_cannot_be_opened_again_holds_up_nothing(void **state) {
    (void)state;
    static const char requests[] = "{\"request\":\"subscribe\",\"to\":\"notices\"}\n";
    int in[2], out[2], status;
    fflush(stdout);
    assert_true(pipe(in) == 0 && pipe(out) == 0);
    assert_int_equal(fchmod(out[1], 0), 0);
    assert_true(write(in[1], requests, sizeof requests - 1) > 0);
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        dup2(in[0], STDIN_FILENO);
        dup2(out[1], STDOUT_FILENO);
        if (geteuid() == 0 && setuid(65534) != 0) {
            _exit(2);
        }
        if (open("/proc/self/fd/1", O_WRONLY | O_NONBLOCK) >= 0) {
            _exit(3);
        }
        flood_standard_output();
    }
    assert_int_equal(waitpid(pid, &status, 0), pid);
    close(in[0]), close(in[1]), close(out[0]), close(out[1]);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

// --- random lines --------------------------------------------------------------------------------

static RandomLine lines[64];

// Checks the replies to lines that have been sent. `before`: requests carried out before.
static void check_replies(int count, int first_id) {
    for (int i = 0; i < count; ++i) {
        const char *text = take(&client);
        cJSON *reply = cJSON_Parse(text);
        const cJSON *ok = cJSON_GetObjectItemCaseSensitive(reply, "ok");
        const cJSON *id = cJSON_GetObjectItemCaseSensitive(reply, "id");
        if (!cJSON_IsBool(ok) || !id || (lines[i].kind == RANDOM_LINE_GOOD && !cJSON_IsTrue(ok)) ||
            (lines[i].kind == RANDOM_LINE_BAD && !cJSON_IsFalse(ok)) ||
            (lines[i].kind == RANDOM_LINE_GOOD && id->valuedouble != first_id + i)) {
            fail_msg("%.*s: %s", (int)lines[i].length, lines[i].bytes, text);
        }
        if (cJSON_IsFalse(ok)) {
            const cJSON *error = cJSON_GetObjectItemCaseSensitive(reply, "error");
            const cJSON *message = cJSON_GetObjectItemCaseSensitive(error, "message");
            assert_true(cJSON_IsString(message) && message->valuestring[0]);
        }
        cJSON_Delete(reply);
    }
    assert_nothing(&client);
}

// Lines are sent in random pieces. Each gets one reply; refused lines never reach the target.
static void ten_thousand_random_lines_get_a_reply_each(void **state) {
    (void)state;
    uint32_t random = 20061;
    connect_client(&client);
    int bad_count = 0;
    for (int id = 0; id < 10000;) {
        int count = 1 + (int)(random >> 20) % 64;
        for (int i = 0; i < count; ++i) {
            random_line_make(&lines[i], &random, id + i);
            // Subscriptions would mix events into the replies, but the target sends none.
            bad_count += lines[i].kind == RANDOM_LINE_BAD;
        }
        for (int i = 0; i < count; ++i) {
            const size_t cut = lines[i].length ? random % lines[i].length : 0;
            assert_int_equal(line_client_send(&client, lines[i].bytes, cut), cut);
            if (random % 3 == 0) {
                dip_control_poll(control);
            }
            line_client_send(&client, lines[i].bytes + cut, lines[i].length - cut);
            assert_int_equal(line_client_send(&client, "\n", 1), 1);
        }
        check_replies(count, id);
        id += count;
    }
    assert_true(bad_count > 2000);
    // A bad line alone changes nothing.
    const int before = seen.count;
    for (int i = 0; i < 1000; ++i) {
        do {
            random_line_make(&lines[0], &random, i);
        } while (lines[0].kind != RANDOM_LINE_BAD);
        line_client_send(&client, lines[0].bytes, lines[0].length);
        line_client_send(&client, "\n", 1);
        check_replies(1, i);
        assert_int_equal(seen.count, before);
    }
}

static void what_is_closed_can_be_closed_again(void **state) {
    (void)state;
    DipControl *none = NULL;
    dip_control_close(&none);
    assert_null(none);
    connect_client(&client);
    dip_control_poll(control);
    dip_control_close(&control);
    assert_null(control);
    dip_control_close(&control);
}

int main(void) {
#define CONTROL_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        CONTROL_TEST(what_is_closed_can_be_closed_again),
        CONTROL_TEST(every_line_gets_one_reply_in_order),
        CONTROL_TEST(refusals_of_the_target_are_errors_in_utf8),
        CONTROL_TEST(lines_may_arrive_in_pieces),
        CONTROL_TEST(long_lines_are_refused_once),
        CONTROL_TEST(a_request_that_is_put_off_holds_up_the_next_ones),
        CONTROL_TEST(a_closed_input_is_answered_before_the_connection_closes),
        CONTROL_TEST(a_client_that_leaves_at_once_is_still_obeyed),
        CONTROL_TEST(events_reach_their_subscribers),
        CONTROL_TEST(a_slow_reader_misses_events_and_is_told),
        CONTROL_TEST(requests_wait_for_a_slow_reader),
        CONTROL_TEST(clients_beyond_the_limit_are_told),
        CONTROL_TEST(only_this_user_can_connect),
        CONTROL_TEST(only_a_stale_socket_is_replaced),
        CONTROL_TEST(closing_removes_only_its_own_socket),
        CONTROL_TEST(standard_streams_carry_the_protocol),
        CONTROL_TEST(a_full_pipe_does_not_hold_up_the_program),
        CONTROL_TEST(a_pipe_that_cannot_be_opened_again_holds_up_nothing),
        CONTROL_TEST(ten_thousand_random_lines_get_a_reply_each),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
