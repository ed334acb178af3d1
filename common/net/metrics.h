// SPDX-License-Identifier: Apache-2.0
// Figures of a process, served to Prometheus as text.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace aquarama::net {

// Sets one series or adds to it; from any thread, without waiting for a reader.
using Record = std::function<void(double)>;
// The labels that distinguish the series of one name: {"node", "left"}.
using Labels = std::map<std::string, std::string>;

// The figures of one process. Names and units follow Prometheus: aquarama_frame_seconds,
// aquarama_late_total. A name has one kind and one help text; with other labels it is another
// series.
class Metrics {
  public:
    // Serves the figures at http://127.0.0.1:PORT/metrics, on its own threads, to this machine
    // only. Port 0: not served. Where the port is taken it logs that, and the figures are not
    // served.
    explicit Metrics(std::uint16_t port);
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    // A series that is set to its present value.
    [[nodiscard]] Record gauge(const std::string& name,
                               const std::string& help,
                               const Labels& labels = {});
    // A series of totals; a smaller total than before is ignored.
    [[nodiscard]] Record counter(const std::string& name,
                                 const std::string& help,
                                 const Labels& labels = {});
    // A series of durations in seconds, counted in buckets from 0.1 ms to 1 s.
    [[nodiscard]] Record histogram(const std::string& name,
                                   const std::string& help,
                                   const Labels& labels = {});
    // All figures, in Prometheus' text format.
    [[nodiscard]] std::string text() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aquarama::net
