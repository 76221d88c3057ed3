/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/mailbox.h"

#include "campaigns/scheduler/types/transport.h"

void fracas_mailbox_open(fracas_mailbox *box)
{
    box->transport->open(box);
}

int fracas_mailbox_stranger(fracas_mailbox *box, const fracas_whereabouts *mine)
{
    return box->transport->stranger(box, mine);
}

void fracas_mailbox_close(fracas_mailbox *box)
{
    box->transport->close(box);
    *box = (fracas_mailbox){0};
}

void fracas_mailbox_abort(const fracas_mailbox *box)
{
    box->transport->abort(box);
}

fracas_err fracas_mailbox_post(fracas_mailbox *box, int to, const fracas_packet *message)
{
    return box->transport->post(box, to, message);
}

fracas_err fracas_mailbox_clear(fracas_mailbox *box)
{
    return box->transport->clear(box);
}

fracas_err fracas_mailbox_receive(fracas_mailbox *box, int *from, fracas_packet **message)
{
    return box->transport->receive(box, from, message);
}

void fracas_mailbox_wait(fracas_mailbox *box, int fd, int most)
{
    box->transport->wait(box, fd, most);
}
