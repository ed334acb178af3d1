// SPDX-License-Identifier: Apache-2.0
// The school's state to and from its message: packed records, checked one by one on arrival.
#pragma once

#include <optional>

#include "common/wire/messages.h"

namespace aquarama {

namespace v1 {
class State;  // generated; its header stays inside the .cpp files
}

void writeState(const StateFrame& state, v1::State& message);
[[nodiscard]] std::optional<StateFrame> readState(const v1::State& message);

}  // namespace aquarama
