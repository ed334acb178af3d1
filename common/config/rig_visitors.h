// SPDX-License-Identifier: Apache-2.0
// What a rig says of those who take part: a theatre's desks, trackers of hands, visitors with
// phones, and drawings.
#pragma once

#include "common/config/rig.h"
#include "common/config/rig.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

// Into a rig that has its channels. Throws Error at the field that is wrong.
void takeVisitors(const TextReader& file, const v1::Rig& in, Rig& rig);

}  // namespace aquarama::config
