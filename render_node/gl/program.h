// SPDX-License-Identifier: Apache-2.0
// Shader programs from the files of render_node/shaders, which are embedded at build time.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render_node/gl/handle.h"

namespace aquarama::gl {

// Includes `by` wherever a file says #include "file": so one shader serves several painters.
struct Replacement {
    std::string_view file, by;
};

// The text of a file of render_node/shaders, with its #include "name" lines expanded. Throws Error
// for an unknown name.
[[nodiscard]] std::string shaderSource(std::string_view name,
                                       std::span<const Replacement> replacements = {});
[[nodiscard]] std::vector<std::string_view> shaderNames();  // every embedded file

// While it lives, every program that this thread makes begins with these lines of #define: what a
// tier leaves out costs nothing, also where a driver runs both sides of every branch.
class Definitions {
  public:
    explicit Definitions(std::string lines);
    ~Definitions();
    Definitions(const Definitions&) = delete;
    Definitions& operator=(const Definitions&) = delete;
    Definitions(Definitions&&) = delete;
    Definitions& operator=(Definitions&&) = delete;

  private:
    std::string outer_;
};

// Compiles and links; the stage follows from the ending: .vert .frag .comp. "#version 450 core" is
// put in front. Throws Error with the driver's log. The first name labels the program.
[[nodiscard]] ProgramHandle makeProgram(const std::vector<std::string>& shaderFiles,
                                        std::span<const Replacement> replacements = {});

}  // namespace aquarama::gl
