// SPDX-License-Identifier: Apache-2.0
// What `aquarama doctor` has found.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/base/log.h"

namespace aquarama {

// Only Fail makes the exit status 1.
enum class Verdict : std::uint8_t { Pass, Warn, Fail };

// The finding of one check, and what to do about it.
struct Finding {
    Verdict verdict = Verdict::Pass;
    std::string subject, what, todo;
};

// All findings, in order.
class Findings {
  public:
    // Adds a finding of what is as it should be.
    void pass(std::string subject, std::string what) {
        all_.push_back({Verdict::Pass, std::move(subject), std::move(what), {}});
    }
    // Adds a finding: Pass where `isGood`, else `otherwise` with the advice `todo`.
    void judge(
        bool isGood, Verdict otherwise, std::string subject, std::string what, std::string todo) {
        if (isGood) return pass(std::move(subject), std::move(what));
        all_.push_back({otherwise, std::move(subject), std::move(what), std::move(todo)});
    }
    void fail(std::string subject, std::string problem) {
        all_.push_back({Verdict::Fail, std::move(subject), std::move(problem), {}});
    }
    // Adds a finding: Pass with the text that `check()` returns, or Fail with the Error that it
    // throws.
    template <class Check>
    bool attempt(const std::string& subject, Check check) {
        try {
            pass(subject, check());
            return true;
        } catch (const Error& problem) {
            fail(subject, problem.what());
            return false;
        }
    }
    [[nodiscard]] const std::vector<Finding>& all() const { return all_; }

  private:
    std::vector<Finding> all_;
};

}  // namespace aquarama
