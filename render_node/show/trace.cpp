// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/trace.h"

#include <fmt/format.h>

namespace aquarama::show {

Trace::Trace(const std::string& folder, const std::string& name) {
    if (folder.empty()) return;
    file_ = GrowingFile(folder + "/" + name + ".csv");
    file_.append("frame,state_ns,ready_ns,present_ns\n");
}

void Trace::write(Frame frame, const FrameTimes& times) {
    if (!file_.isOpen()) return;
    file_.appendOrLog(fmt::format("{},{},{},{}\n",
                                  frame.value,
                                  times.state.time_since_epoch().count(),
                                  times.ready.time_since_epoch().count(),
                                  times.present.time_since_epoch().count()));
}

}  // namespace aquarama::show
