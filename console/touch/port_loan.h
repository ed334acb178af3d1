// SPDX-License-Identifier: Apache-2.0
// The port of the tracker, which the console of a rig lends to `aquarama touch` while that runs.
#pragma once

#include <string>

namespace aquarama::console {

// A lock of this user, which ends with the process.
class PortLoan {
  public:
    // Asks the console for the port. Throws Error where another `aquarama touch` has it.
    explicit PortLoan(const std::string& rigFile);
    ~PortLoan();
    PortLoan(const PortLoan&) = delete;
    PortLoan& operator=(const PortLoan&) = delete;

    // For the console: whether somebody asks for the port. Does not wait.
    [[nodiscard]] static bool isAsked(const std::string& rigFile);

  private:
    int lock_;
};

// A running console of this user has given the port up after so long, seconds.
inline constexpr double kLoanSeconds = 4;

}  // namespace aquarama::console
