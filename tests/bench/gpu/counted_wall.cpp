// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/counted_wall.h"

#include <epoxy/gl.h>

#include "common/base/log.h"
#include "render_node/gl/handle.h"
#include "render_node/show/channel_picture.h"

namespace aquarama::bench {

CallCounts countedWall(const Sea& sea,
                       const config::Rig& rig,
                       config::QualityTier quality,
                       CallCounter& counter) {
    session::Admission admission = sea.admission;
    admission.rig = rig;
    CallCounts sum;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        show::ChannelPicture channel(admission, i, quality);
        const gl::Target target(GL_RGBA8, rig.channels[i].sizePixels);
        const auto counted = [&](const wire::StateFrame& frame) {
            channel.drawScene(frame, {});
            channel.project(target.framebuffer(), show::Encoding::Dithered8, {});
            return counter.take();
        };
        glEnable(GL_RASTERIZER_DISCARD);
        (void)counted(sea.frames.at(0));
        glDisable(GL_RASTERIZER_DISCARD);
        for (const auto& [kind, work] : counted(sea.frames.at(1))) sum[kind] += work;
        logInfo("{} of {} channels counted", i + 1, rig.channels.size());
    }
    return sum;
}

void writeCounts(std::ostream& file, const std::string& wall, const CallCounts& counts) {
    for (const auto& [kind, of] : counts)
        file << wall << ',' << kind.stage << ',' << kind.program << ',' << of.calls << ','
             << of.work.vertices << ',' << of.work.primitives << ',' << of.work.fragments << ','
             << of.samples << ',' << kind.targetSamples << ',' << kind.pixelBytes << ','
             << of.work.computed << ',' << of.bytes << '\n';
    file.flush();
}

}  // namespace aquarama::bench
