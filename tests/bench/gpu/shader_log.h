// SPDX-License-Identifier: Apache-2.0
// What a driver tells of the shaders that it compiles, by program: statistics, and with
// AMD_DEBUG=vs,gs,ps,cs,asm of AMD's driver their code.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace aquarama::bench {

// While it lives, messages of the current context (GL_KHR_debug) are written to a file, at the call
// that causes them. A line "=== program LABEL" follows those that belong to the program.
class ShaderLog {
  public:
    // Throws Error where the file cannot be written.
    explicit ShaderLog(const std::filesystem::path& file);
    ~ShaderLog();
    ShaderLog(const ShaderLog&) = delete;
    ShaderLog& operator=(const ShaderLog&) = delete;

    void add(const char* message);
    // What was written since the last call of it belongs to this program.
    void belongsTo(const std::string& program);

  private:
    std::ofstream file_;
    bool isBelonging_ = true;  // all that was written
};

}  // namespace aquarama::bench
