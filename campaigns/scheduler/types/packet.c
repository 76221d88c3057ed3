/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/packet.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

fracas_err fracas_packet_create(fracas_packet_kind kind, const void *body, size_t size,
                                fracas_packet **message)
{
    if (size > INT32_MAX - sizeof(fracas_packet)) /* MPI counts in int */
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "a message of %zu bytes is above the limit of %d; use a smaller "
                           "--segment-size, or fewer output.history rows",
                           size, INT32_MAX);
    fracas_packet *m = malloc(sizeof *m + size);
    if (!m) return fracas_no_memory("a message");
    *m = (fracas_packet){.kind = kind, .size = (uint32_t)size};
    if (body) memcpy(m->body, body, size);
    *message = m;
    return FRACAS_OK;
}

size_t fracas_packet_bytes(const fracas_packet *message)
{
    return sizeof *message + message->size;
}

fracas_err fracas_packet_body(const fracas_packet *message, void *body, size_t size)
{
    if (message->size < size)
        return fracas_fail(FRACAS_BUG, "message of kind %u has %u bytes, it must have %zu",
                           message->kind, message->size, size);
    memcpy(body, message->body, size);
    return FRACAS_OK;
}

void fracas_trouble_take(fracas_err code, fracas_trouble *trouble)
{
    memset(trouble, 0, sizeof *trouble);
    trouble->code = code;
    strncpy(trouble->text, fracas_message(), sizeof trouble->text - 1);
}

fracas_err fracas_trouble_fail(const fracas_trouble *trouble)
{
    if (!trouble->code) return FRACAS_OK;
    return fracas_fail((fracas_err)trouble->code, "%s", trouble->text);
}

fracas_err fracas_packet_write(int fd, const fracas_packet *message)
{
    const unsigned char *from = (const unsigned char *)message;
    for (size_t left = fracas_packet_bytes(message); left > 0;) {
        ssize_t n = write(fd, from, left);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0)
            return fracas_fail(FRACAS_ENVIRONMENT, "cannot write to a process of this run: %s",
                               strerror(errno));
        from += n;
        left -= (size_t)n;
    }
    return FRACAS_OK;
}

fracas_err fracas_packet_send(int fd, fracas_packet_kind kind, const void *body, size_t size)
{
    OWNED fracas_packet *message = NULL;
    TRY(fracas_packet_create(kind, body, size, &message));
    return fracas_packet_write(fd, message);
}

/* Reads `size` bytes, fewer at the end of the stream. */
static fracas_err read_whole(int fd, void *to, size_t size, size_t *got)
{
    *got = 0;
    while (*got < size) {
        ssize_t n = read(fd, (unsigned char *)to + *got, size - *got);
        if (n < 0 && errno == EINTR) continue;
        if (n == 0 || (n < 0 && errno == ECONNRESET)) break;
        if (n < 0)
            return fracas_fail(FRACAS_ENVIRONMENT, "cannot read from a process of this run: %s",
                               strerror(errno));
        *got += (size_t)n;
    }
    return FRACAS_OK;
}

fracas_err fracas_packet_read(int fd, fracas_packet **message)
{
    *message = NULL;
    fracas_packet head;
    size_t got;
    TRY(read_whole(fd, &head, sizeof head, &got));
    if (got < sizeof head) return FRACAS_OK; /* also if the writer was killed within a message */
    OWNED fracas_packet *m = malloc(sizeof *m + head.size);
    if (!m) return fracas_no_memory("a message");
    *m = head;
    TRY(read_whole(fd, m->body, head.size, &got));
    if (got < head.size) return FRACAS_OK;
    *message = m;
    m = NULL;
    return FRACAS_OK;
}
