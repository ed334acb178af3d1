// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/machine.h"

#include <cctype>
#include <fstream>
#include <utility>

#include <sys/utsname.h>

namespace aquarama::bench {

std::string processorName() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    utsname machine{};
    uname(&machine);
    return machine.machine;
}

std::string fileNameOf(const std::string& machine) {
    std::string name;
    for (const char letter : machine) {
        const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
        if (plain) name += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
        if (!plain && !name.empty() && name.back() != '-') name += '-';
    }
    return name.substr(0, name.find_last_not_of('-') + 1);
}

CsvWriter::CsvWriter(std::ostream& file, std::string machine)
    : file_{file}, machine_{std::move(machine)} {
    file_ << kCsvHead << '\n';
}

void CsvWriter::time(const std::string& benchmark, double cpuNanoseconds) {
    file_ << '"' << machine_ << "\"," << benchmark << ',' << cpuNanoseconds << ",,\n";
}

void CsvWriter::counter(const std::string& benchmark, const std::string& name, double value) {
    file_ << '"' << machine_ << "\"," << benchmark << ",," << name << ',' << value << '\n';
}

}  // namespace aquarama::bench
