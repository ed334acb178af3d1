// SPDX-License-Identifier: Apache-2.0
// On what a benchmark ran, and the rows in which its figures are kept.
#pragma once

#include <ostream>
#include <string>

namespace aquarama::bench {

[[nodiscard]] std::string processorName();

// "Intel(R) Xeon(R) Processor" as a name for a file: intel-r-xeon-r-processor.
[[nodiscard]] std::string fileNameOf(const std::string& machine);

// The first line of a file of measurements.
inline constexpr const char* kCsvHead = "machine,benchmark,cpu_ns,counter,value";

// Writes the form of docs/measurements: a row for the time of a benchmark, one for each counter.
class CsvWriter {
  public:
    CsvWriter(std::ostream& file, std::string machine);
    void time(const std::string& benchmark, double cpuNanoseconds);
    void counter(const std::string& benchmark, const std::string& name, double value);

  private:
    std::ostream& file_;
    std::string machine_;
};

}  // namespace aquarama::bench
