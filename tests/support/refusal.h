// SPDX-License-Identifier: Apache-2.0
// What a work is refused for.
#pragma once

#include <functional>
#include <string>

#include "common/base/log.h"

namespace aquarama::test {

// The text of the Error that it throws; empty where it throws none.
inline std::string refusalOf(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace aquarama::test
