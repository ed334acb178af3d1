// SPDX-License-Identifier: Apache-2.0
// The school's state to and from its message: packed records, checked one by one on arrival.
#pragma once

#include <optional>

#include <google/protobuf/repeated_field.h>

#include "common/wire/messages.h"

namespace aquarama::v1 {
class State;  // generated; its header stays inside the .cpp files
}

namespace aquarama::wire {

// x y z in metres, then w x y z of worldFromWall.
void writeEye(const Eye& eye, google::protobuf::RepeatedField<float>& numbers);
[[nodiscard]] std::optional<Eye> readEye(const google::protobuf::RepeatedField<float>& numbers);

void writeState(const StateFrame& state, v1::State& message);
[[nodiscard]] std::optional<StateFrame> readState(const v1::State& message);

}  // namespace aquarama::wire
