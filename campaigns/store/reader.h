/* What the rest of the store asks of a reader beside store.h. */
#ifndef FRACAS_CAMPAIGNS_STORE_READER_H
#define FRACAS_CAMPAIGNS_STORE_READER_H

#include "campaigns/store/store.h"

bool fracas_reader_has_interfaces(const fracas_reader *reader);

#endif
