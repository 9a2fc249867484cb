// SPDX-License-Identifier: Apache-2.0
// Requests and answers of HTTP/1.1 (RFC 9112) as text. In: the bytes of a connection, from anybody. Out: one request
// after the other, or the answer with which the connection ends. Bodies have a Content-Length; what is longer than the
// limits is refused before it is kept. Called by http_server.cpp.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rung::host {

inline constexpr size_t kLongestRequestLine = size_t{64} << 10;
inline constexpr size_t kLongestHeaders = size_t{16} << 10;
inline constexpr size_t kLongestBody = size_t{1} << 20;

struct HttpRequest {
  std::string method, path;                                // of the path without `?…`
  std::vector<std::pair<std::string, std::string>> query;  // decoded, in order
  std::string host, origin, authorization;                 // headers; empty: not there
  std::string body;
  bool keeps_alive = true;

  // The first one of this name; null: there is none.
  const std::string* parameter(std::string_view name) const;
};

struct HttpReply {
  int status = 200;
  std::string body;
  std::string type = "application/json";
  std::string allow;         // of 405: the methods that there are
  std::string script_nonce;  // of a page: only scripts with it run
  bool closes = false;
};
// {"error": sentence}.
HttpReply httpError(int status, std::string_view sentence);

// `is_kept`: the connection may go on after it. Without a body: the head of a stream of events.
std::string httpText(const HttpReply& reply, bool is_kept);
std::string httpStreamHead();

class HttpReader {
 public:
  void add(const char* bytes, size_t count) { bytes_.append(bytes, count); }
  enum class State : uint8_t { Incomplete, Complete, Broken };
  // The next request; or why there is none, after which nothing more can be read.
  State next(HttpRequest& request, HttpReply& refusal);
  bool isEmpty() const { return bytes_.empty(); }

 private:
  State readHead(HttpRequest& request, HttpReply& refusal);
  const char* readFields(std::string_view line, std::string_view headers, HttpRequest& request);
  static State broken(HttpReply& refusal, int status, std::string_view sentence);

  std::string bytes_;
  size_t searched_ = 0;      // of bytes_: no head ends before it
  bool has_head_ = false;    // of the request whose body is not complete
  HttpRequest request_;      // that one
  size_t missing_body_ = 0;  // its bytes
};

}  // namespace rung::host
