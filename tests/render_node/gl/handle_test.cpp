// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/handle.h"

#include <optional>
#include <set>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

namespace aquarama::gl {
namespace {

// A fake driver: it knows which names are alive, and minds a name that is freed twice.
std::multiset<unsigned>& liveNames() {
    static std::multiset<unsigned> names;
    return names;
}

struct FakeTraits {
    static unsigned create() {
        static unsigned next = 0;
        return *liveNames().insert(++next);
    }
    static void destroy(unsigned name) {
        EXPECT_EQ(liveNames().erase(name), 1U) << "name " << name << " freed twice";
    }
};
using FakeHandle = Handle<FakeTraits>;

static_assert(!std::is_copy_constructible_v<FakeHandle>);

TEST(Handle, freesItsNameAtTheEndOfItsLife) {
    {
        const FakeHandle handle;
        EXPECT_EQ(liveNames(), std::multiset<unsigned>{handle.name()});
    }
    EXPECT_TRUE(liveNames().empty());
}

TEST(Handle, movingHandsTheNameOn) {
    FakeHandle first;
    const unsigned name = first.name();
    const FakeHandle second = std::move(first);
    EXPECT_EQ(second.name(), name);
    EXPECT_EQ(liveNames().size(), 1U);
}

TEST(Handle, reassigningFreesTheOldNameAndKeepsTheNewOne) {
    {
        std::optional<FakeHandle> handle;
        handle = FakeHandle{};
        handle = FakeHandle{};
        EXPECT_EQ(liveNames(), std::multiset<unsigned>{handle->name()});
    }
    EXPECT_TRUE(liveNames().empty());
}

}  // namespace
}  // namespace aquarama::gl
