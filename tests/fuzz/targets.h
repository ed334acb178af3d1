// SPDX-License-Identifier: Apache-2.0
// What is fuzzed: every reader of bytes from outside. Each takes any bytes in the form of
// LLVMFuzzerTestOneInput; it aborts where a reader breaks its promise, which is to refuse with an
// Error or to mean exactly what was read.
#pragma once

#include <cstddef>
#include <cstdint>

namespace aquarama {

int fuzzRepertoire(const std::uint8_t* bytes, std::size_t size);
int fuzzSpecies(const std::uint8_t* bytes, std::size_t size);
int fuzzAdjustments(const std::uint8_t* bytes, std::size_t size);
int fuzzRig(const std::uint8_t* bytes, std::size_t size);
int fuzzKeys(const std::uint8_t* bytes, std::size_t size);
int fuzzScene(const std::uint8_t* bytes, std::size_t size);
int fuzzShow(const std::uint8_t* bytes, std::size_t size);
int fuzzWire(const std::uint8_t* bytes, std::size_t size);
int fuzzDepot(const std::uint8_t* bytes, std::size_t size);
int fuzzRecording(const std::uint8_t* bytes, std::size_t size);
int fuzzSave(const std::uint8_t* bytes, std::size_t size);
int fuzzSchool(const std::uint8_t* bytes, std::size_t size);
int fuzzVendors(const std::uint8_t* bytes, std::size_t size);
int fuzzHours(const std::uint8_t* bytes, std::size_t size);
int fuzzBrowser(const std::uint8_t* bytes, std::size_t size);
int fuzzPjlink(const std::uint8_t* bytes, std::size_t size);
int fuzzOsc(const std::uint8_t* bytes, std::size_t size);
int fuzzEnrol(const std::uint8_t* bytes, std::size_t size);
int fuzzTuio(const std::uint8_t* bytes, std::size_t size);
int fuzzMpcdi(const std::uint8_t* bytes, std::size_t size);
int fuzzPhoto(const std::uint8_t* bytes, std::size_t size);
int fuzzDecoder(const std::uint8_t* bytes, std::size_t size);

}  // namespace aquarama
