// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace dust::sdk {

/// Thrown by a model whose parameters contradict each other. The core adds file and line.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown by a model that meets an input outside what it can compute (non-finite, impossible).
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dust::sdk
