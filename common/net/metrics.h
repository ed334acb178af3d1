// SPDX-License-Identifier: Apache-2.0
// Figures of a process, served as text for Prometheus.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace aquarama::net {

// Sets or adds to one series; from any thread, without waiting for a reader.
using Record = std::function<void(double)>;
// What tells the series of one name apart: {"node", "left"}.
using Labels = std::map<std::string, std::string>;

// The figures of one process. Names and units follow Prometheus: aquarama_frame_seconds,
// aquarama_late_total. A name has one kind and one help text; made again with other labels it is
// another series of it.
class Metrics {
  public:
    // Served at http://127.0.0.1:PORT/metrics, by threads of its own, to this machine only. Port 0:
    // nowhere. Where the port is taken the log says so, and the figures are served nowhere.
    explicit Metrics(std::uint16_t port);
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    // The value now.
    [[nodiscard]] Record gauge(const std::string& name,
                               const std::string& help,
                               const Labels& labels = {});
    // The total so far; a smaller one than before is ignored.
    [[nodiscard]] Record counter(const std::string& name,
                                 const std::string& help,
                                 const Labels& labels = {});
    // One duration in seconds, counted into buckets from 0.1 ms to 1 s.
    [[nodiscard]] Record histogram(const std::string& name,
                                   const std::string& help,
                                   const Labels& labels = {});
    // All of it, in Prometheus' text format.
    [[nodiscard]] std::string text() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aquarama::net
