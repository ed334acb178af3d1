// SPDX-License-Identifier: Apache-2.0
// The parts of Asio and Beast that need not be headers, compiled once.
#include <utility>  // before Asio, whose awaitable.hpp of Boost 1.74 forgets it

#include <boost/asio/impl/src.hpp>
#include <boost/asio/ssl/impl/src.hpp>
#include <boost/beast/src.hpp>
