// SPDX-License-Identifier: Apache-2.0
// Requests and answers of HTTP: see http.h.
#include "http.h"

#include <algorithm>
#include <charconv>

#include "json.h"
#include "symbols.h"

namespace rung::host {
namespace {

const char* reasonOf(int status) {
  switch (status) {
    case 200: return "OK";
    case 400: return "Bad Request";
    case 401: return "Unauthorized";
    case 403: return "Forbidden";
    case 404: return "Not Found";
    case 405: return "Method Not Allowed";
    case 409: return "Conflict";
    case 413: return "Content Too Large";
    case 503: return "Service Unavailable";
    default: return "Error";
  }
}

bool isToken(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return c > ' ' && c < 0x7f && std::string_view("\"(),/:;<=>?@[\\]{}").find(c) == std::string_view::npos;
  });
}

int digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

// `%2F`, and in a query `+` for a blank. False: a `%` without two digits.
bool decode(std::string_view text, std::string& to, bool is_query) {
  to.clear();
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%') {
      const int high = i + 2 < text.size() ? digitOf(text[i + 1]) : -1, low = high < 0 ? -1 : digitOf(text[i + 2]);
      if (low < 0) return false;
      to += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      to += is_query && text[i] == '+' ? ' ' : text[i];
    }
  }
  return true;
}

std::string_view takeUntil(std::string_view& text, std::string_view end) {
  const size_t at = std::min(text.find(end), text.size());
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(std::min(at + end.size(), text.size()));
  return part;
}

bool readTarget(std::string_view target, HttpRequest& request) {
  if (target.empty() || target[0] != '/') return false;
  if (!decode(takeUntil(target, "?"), request.path, false)) return false;
  while (!target.empty()) {
    std::string_view value = takeUntil(target, "&");
    auto& [name, decoded] = request.query.emplace_back();
    if (!decode(takeUntil(value, "="), name, true) || !decode(value, decoded, true)) return false;
  }
  return true;
}

// `GET /api/info HTTP/1.1`
bool readRequestLine(std::string_view line, HttpRequest& request) {
  const auto isText = [](char c) { return c > 0x1f && c < 0x7f; };
  if (!std::all_of(line.begin(), line.end(), isText)) return false;
  request.method = takeUntil(line, " ");
  const std::string_view target = takeUntil(line, " ");
  request.keeps_alive = line == "HTTP/1.1";
  return isToken(request.method) && (line == "HTTP/1.1" || line == "HTTP/1.0") && readTarget(target, request);
}

bool readLength(std::string_view text, size_t& length) {
  const std::from_chars_result read = std::from_chars(text.data(), text.data() + text.size(), length);
  return !text.empty() && read.ec == std::errc{} && read.ptr == text.data() + text.size();
}

// What is asked of the headers as a whole.
struct Headers {
  std::string length;
  uint32_t hosts = 0, lengths = 0;
  bool has_coding = false;
};

bool readHeader(std::string_view line, HttpRequest& request, Headers& seen) {
  if (line.find(':') == std::string_view::npos) return false;
  const std::string_view name = takeUntil(line, ":");
  if (!isToken(name) || line.find_first_of(std::string_view("\0\n\r", 3)) != std::string_view::npos) return false;
  const std::string_view value = trimmed(line);
  const std::string lower = lowerCase(name);
  if (lower == "host") {
    request.host = value;
    ++seen.hosts;
  } else if (lower == "content-length") {
    seen.length = value;
    ++seen.lengths;
  } else if (lower == "origin") {
    request.origin = value;
  } else if (lower == "authorization") {
    request.authorization = value;
  } else if (lower == "connection") {
    if (lowerCase(value) == "close") request.keeps_alive = false;
  } else if (lower == "transfer-encoding") {
    seen.has_coding = true;
  }
  return true;
}

std::string headOf(int status) { return "HTTP/1.1 " + std::to_string(status) + ' ' + reasonOf(status) + "\r\n"; }

// No other page may read or frame an answer, and the token in the URL goes nowhere.
constexpr std::string_view kCommonHeaders =
    "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n"
    "X-Frame-Options: DENY\r\n"
    "Content-Security-Policy: default-src 'none'; style-src 'unsafe-inline'; img-src data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'";

// The scripts of the page itself run, and no others.
std::string securityHeaders(const std::string& nonce) {
  return std::string(kCommonHeaders) + (nonce.empty() ? "" : "; script-src 'nonce-" + nonce + "'") + "\r\n";
}

}  // namespace

const std::string* HttpRequest::parameter(std::string_view name) const {
  for (const auto& [key, value] : query)
    if (key == name) return &value;
  return nullptr;
}

HttpReply httpError(int status, std::string_view sentence) {
  HttpReply reply;
  reply.status = status;
  reply.body = Json{{"error", sentence}}.toText();
  return reply;
}

std::string httpText(const HttpReply& reply, bool is_kept) {
  std::string text = headOf(reply.status);
  text += "Content-Type: " + reply.type + "\r\nContent-Length: " + std::to_string(reply.body.size()) + "\r\n";
  if (!reply.allow.empty()) text += "Allow: " + reply.allow + "\r\n";
  if (reply.status == 401) text += "WWW-Authenticate: Bearer\r\n";
  text += securityHeaders(reply.script_nonce);
  text += is_kept ? "\r\n" : "Connection: close\r\n\r\n";
  return text += reply.body;
}

std::string httpStreamHead() {
  std::string text = headOf(200) + "Content-Type: text/event-stream\r\n";
  text += securityHeaders("");
  return text += "Connection: close\r\n\r\n";
}

HttpReader::State HttpReader::broken(HttpReply& refusal, int status, std::string_view sentence) {
  refusal = httpError(status, sentence);
  refusal.closes = true;
  return State::Broken;
}

HttpReader::State HttpReader::next(HttpRequest& request, HttpReply& refusal) {
  if (!has_head_) {
    const State state = readHead(request_, refusal);
    if (state != State::Complete) return state;
    has_head_ = true;
  }
  if (bytes_.size() < missing_body_) return State::Incomplete;
  request = std::move(request_);
  request_ = HttpRequest();
  request.body = bytes_.substr(0, missing_body_);
  bytes_.erase(0, missing_body_);
  searched_ = missing_body_ = 0;
  has_head_ = false;
  return State::Complete;
}

// Garbage is noticed by its first bytes, not after as many as a head may have.
HttpReader::State HttpReader::readHead(HttpRequest& request, HttpReply& refusal) {
  constexpr size_t kLongestMethod = 16;
  const std::string_view beginning = std::string_view(bytes_).substr(0, kLongestMethod);
  const std::string_view method = beginning.substr(0, beginning.find(' '));
  if ((!method.empty() && !isToken(method)) || method.size() == kLongestMethod)
    return broken(refusal, 400, "this is not HTTP/1.1");
  const size_t end = bytes_.find("\r\n\r\n", searched_);
  if (end == std::string::npos && bytes_.size() <= kLongestRequestLine + kLongestHeaders) {
    searched_ = bytes_.size() < 3 ? 0 : bytes_.size() - 3;
    return State::Incomplete;
  }
  std::string_view head = std::string_view(bytes_).substr(0, end);
  const std::string_view line = takeUntil(head, "\r\n");
  if (line.size() > kLongestRequestLine)
    return broken(refusal, 413, "the request line is longer than 64 kB; POST the paths to /api/watch");
  if (head.size() > kLongestHeaders) return broken(refusal, 413, "the headers are longer than 16 kB");
  const char* const wrong = readFields(line, head, request);
  if (wrong != nullptr) return broken(refusal, 400, wrong);
  if (missing_body_ > kLongestBody) return broken(refusal, 413, "the body is longer than 1 MB");
  bytes_.erase(0, end + 4);
  searched_ = 0;
  return State::Complete;
}

// Null, or what is wrong with the head.
const char* HttpReader::readFields(std::string_view line, std::string_view headers, HttpRequest& request) {
  if (!readRequestLine(line, request)) return "the request line is not one of HTTP/1.1";
  Headers seen;
  while (!headers.empty())
    if (!readHeader(takeUntil(headers, "\r\n"), request, seen)) return "a header is not one of HTTP/1.1";
  if (seen.has_coding) return "a body needs a Content-Length, no Transfer-Encoding";
  if (seen.hosts != 1) return "a request has one Host";
  if (seen.lengths > 1) return "a request has one Content-Length";
  if (seen.lengths == 1 && !readLength(seen.length, missing_body_)) return "the Content-Length is not a number";
  return nullptr;
}

}  // namespace rung::host
