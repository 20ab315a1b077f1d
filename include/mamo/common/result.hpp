// A value or the one line that says why there is none. Used for bad input and normal failure;
// exceptions are for misuse by the caller, assertions for our own bugs.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace mamo {

/// Which exit code an error leads to (INTERFACE: 3, 64, 73, 70).
enum class ErrorKind { invalid_input, usage, output, internal };

/// One line for a person: `file:line:column: what is wrong, what was expected` where there is a place.
struct Error {
  std::string message;
  ErrorKind kind = ErrorKind::invalid_input;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return std::get<1>(state_); }

  /// The value. Throws std::logic_error (with the message) when there is none: check first.
  T& value() & { return demand(), std::get<0>(state_); }
  const T& value() const& { return demand(), std::get<0>(state_); }
  T&& value() && { return demand(), std::get<0>(std::move(state_)); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }

 private:
  void demand() const {
    if (!ok()) throw std::logic_error("value of a failed result: " + error().message);
  }
  std::variant<T, Error> state_;
};

/// Success, or the error.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}
  bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace mamo
