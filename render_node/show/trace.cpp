// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/trace.h"

#include "common/units/error.h"

namespace aquarama::show {

Trace::Trace(const std::string& folder, const std::string& name) {
    if (folder.empty()) return;
    const std::string path = folder + "/" + name + ".csv";
    std::ofstream(path, std::ios::trunc);
    file_.open(path, std::ios::app);  // who empties it while it is written gets no hole
    if (!(file_ << "frame,state_ns,ready_ns,present_ns\n" << std::flush))
        throw Error(path + ": cannot be written; choose a folder that exists for --trace");
}

void Trace::write(Frame frame, const FrameTimes& times) {
    if (!file_.is_open()) return;
    file_ << frame.value << ',' << times.state.count() << ',' << times.ready.count() << ','
          << times.present.count() << '\n'
          << std::flush;
}

}  // namespace aquarama::show
