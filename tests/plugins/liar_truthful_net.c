/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slack_net.h"

/* The net of liar_net without its lie. */
LIAR_NET("liar_truthful_net", slack_net);
