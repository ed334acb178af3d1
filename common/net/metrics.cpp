// SPDX-License-Identifier: Apache-2.0
#include "common/net/metrics.h"

#include <chrono>
#include <exception>
#include <stop_token>
#include <thread>

#include <arpa/inet.h>
#include <prometheus/counter.h>
#include <prometheus/exposer.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::net {
namespace {

// Upper limits of the buckets, seconds: fine near a release and a refresh of 60 Hz, coarse above.
const prometheus::Histogram::BucketBoundaries& buckets() {
    static const prometheus::Histogram::BucketBoundaries ends{0.0001,
                                                              0.0002,
                                                              0.0005,
                                                              0.001,
                                                              0.002,
                                                              0.004,
                                                              0.008,
                                                              0.012,
                                                              0.016,
                                                              0.018,
                                                              0.02,
                                                              0.025,
                                                              0.034,
                                                              0.05,
                                                              0.1,
                                                              0.2,
                                                              0.5,
                                                              1.0};
    return ends;
}

// Opens a connection to this port of the loopback, and closes it.
void knockAt(std::uint16_t port) {
    const int connection = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    if (connection < 0) return;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    // A failed attempt does not matter.
    static_cast<void>(
        connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address));
    close(connection);
}

}  // namespace

struct Metrics::Impl {
    std::shared_ptr<prometheus::Registry> registry = std::make_shared<prometheus::Registry>();
    std::unique_ptr<prometheus::Exposer> exposer;
    std::uint16_t port = 0;
};

Metrics::Metrics(std::uint16_t port) : impl_(std::make_unique<Impl>()) {
    if (port == 0) return;
    impl_->port = port;
    const std::string address = "127.0.0.1:" + std::to_string(port);
    try {
        impl_->exposer = std::make_unique<prometheus::Exposer>(address, 1);
        impl_->exposer->RegisterCollectable(impl_->registry);
    } catch (const std::exception&) {
        impl_->exposer.reset();
        logWarning(
            "no figures are served at {}: the port is taken; choose another metrics_port in the "
            "rig",
            address);
    }
}

// The server, civetweb, checks whether it shall end every two seconds and with each connection.
Metrics::~Metrics() {
    if (!impl_->exposer) return;
    const std::jthread knocking([port = impl_->port](const std::stop_token& ended) {
        while (!ended.stop_requested()) {
            knockAt(port);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    });
    impl_->exposer.reset();
}

Record Metrics::gauge(const std::string& name, const std::string& help, const Labels& labels) {
    auto& family = prometheus::BuildGauge().Name(name).Help(help).Register(*impl_->registry);
    return [&series = family.Add(labels)](double value) { series.Set(value); };
}

Record Metrics::counter(const std::string& name, const std::string& help, const Labels& labels) {
    auto& family = prometheus::BuildCounter().Name(name).Help(help).Register(*impl_->registry);
    return [&series = family.Add(labels)](double total) {
        const double more = total - series.Value();
        if (more > 0) series.Increment(more);
    };
}

Record Metrics::histogram(const std::string& name, const std::string& help, const Labels& labels) {
    auto& family = prometheus::BuildHistogram().Name(name).Help(help).Register(*impl_->registry);
    return [&series = family.Add(labels, buckets())](double seconds) { series.Observe(seconds); };
}

std::string Metrics::text() const {
    return prometheus::TextSerializer().Serialize(impl_->registry->Collect());
}

}  // namespace aquarama::net
