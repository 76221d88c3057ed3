/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /campaign of a study.h5: the campaign's text and its files. Private to the store. */
#ifndef FRACAS_CAMPAIGNS_STORE_FILE_COPY_H
#define FRACAS_CAMPAIGNS_STORE_FILE_COPY_H

#include "campaigns/store/file/h5.h"
#include "campaigns/points.h"

#define FRACAS_COPY_GROUP "/campaign"

FRACAS_MUST_USE fracas_err fracas_copy_write(const fracas_h5 *h5, const fracas_campaign_copy *copy);
/* *copy must be all zero; cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_copy_read(const fracas_h5 *h5, fracas_campaign_copy *copy);

#endif
