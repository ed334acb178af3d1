// SPDX-License-Identifier: Apache-2.0
// Reads a C3D file by its specification (The C3D File Format User Guide, Motion Lab Systems 2008),
// with none of the writer's code: Intel byte order, floating-point data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace aquarama::test {

class C3dFile {
  public:
    explicit C3dFile(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {
        if (at<std::uint8_t>(1) != 0x50) throw std::runtime_error("no C3D file");
        readParameters((at<std::uint8_t>(0) - std::size_t{1}) * 512);
    }

    template <class T>
    [[nodiscard]] T at(std::size_t offset) const {
        T value{};
        if (offset + sizeof(T) > bytes_.size()) throw std::out_of_range("past the end");
        std::memcpy(&value, &bytes_[offset], sizeof(T));
        return value;
    }
    // Where the elements of "GROUP:NAME" are.
    [[nodiscard]] std::size_t elements(const std::string& name) const {
        const std::size_t dimensions = at<std::uint8_t>(parameters_.at(name) + 1);
        return parameters_.at(name) + 2 + dimensions;
    }
    template <class T>
    [[nodiscard]] T number(const std::string& name) const {
        return at<T>(elements(name));
    }
    [[nodiscard]] std::vector<std::string> strings(const std::string& name) const {
        const std::size_t length = at<std::uint8_t>(parameters_.at(name) + 2);
        const std::size_t dimensions = at<std::uint8_t>(parameters_.at(name) + 1);
        const std::size_t count = dimensions > 1 ? at<std::uint8_t>(parameters_.at(name) + 3) : 1U;
        std::vector<std::string> values;
        for (std::size_t i = 0; i < count; ++i) {
            values.push_back(text(elements(name) + i * length, length));
            values.back().erase(values.back().find_last_not_of(' ') + 1);
        }
        return values;
    }
    // Coordinate 0, 1, 2 of a marker; 3 is its residual and cameras.
    [[nodiscard]] float data(std::size_t frame, std::size_t marker, std::size_t coordinate) const {
        const std::size_t block = at<std::uint16_t>(16);
        const std::size_t markers = at<std::uint16_t>(2);
        return at<float>((block - 1) * 512 + 4 * (4 * (frame * markers + marker) + coordinate));
    }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }

  private:
    [[nodiscard]] std::string text(std::size_t offset, std::size_t length) const {
        std::string characters;
        for (std::size_t i = 0; i < length; ++i) characters += at<char>(offset + i);
        return characters;
    }

    void readParameters(std::size_t section) {
        if (at<std::uint8_t>(section + 3) != 84) throw std::runtime_error("not of Intel order");
        std::map<int, std::string> groups;
        for (std::size_t record = section + 4;;) {
            const std::size_t length = at<std::uint8_t>(record);
            const auto group = static_cast<int>(at<std::int8_t>(record + 1));
            const std::string name = text(record + 2, length);
            const std::size_t pointer = record + 2 + length;
            if (group < 0) {
                groups[-group] = name;
            } else {
                parameters_[groups.at(group) + ":" + name] = pointer + 2;
            }
            const std::size_t next = at<std::uint16_t>(pointer);
            if (next == 0) break;
            record = pointer + next;
        }
    }

    std::vector<std::byte> bytes_;
    std::map<std::string, std::size_t> parameters_;  // where the type of the elements is
};

}  // namespace aquarama::test
