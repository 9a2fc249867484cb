// SPDX-License-Identifier: Apache-2.0
// Sockets and serial lines of this machine, all without waiting. In: addresses and settings as programs give them. Out:
// a descriptor, or -1 and a rung_channel_error. Called by channels.cpp and modbus_server.cpp.
#pragma once

#include <netinet/in.h>
#include <cstdint>

#include "rung/module.h"

namespace rung::host {

// `192.168.1.13`; empty is 0.0.0.0. False: not an address.
bool readAddress(const char* text, uint32_t& address);
sockaddr_in socketAddress(uint32_t address, uint16_t port);

// `connected`: already; else the descriptor becomes writable when it is decided.
int openTcpClient(uint32_t address, uint16_t port, bool& connected, int32_t& error);
int openTcpServer(uint32_t address, uint16_t port, int32_t& error);
int openUdp(uint32_t address, uint16_t port, int32_t& error);
// -1: none waits. The connection does not delay small writes, and notices a peer that vanished.
int acceptClient(int server, int32_t& error);
// After a connection attempt: 0, or a rung_channel_error.
int32_t connectError(int fd);
int openSerial(const char* device, const rung_channel_settings& settings, int32_t& error);
// Bytes that a serial line has yet to send.
uint32_t unsentOfDriver(int fd);

// The address of this machine in its network, as text; null: it has none.
const char* findOwnAddress(char* text, uint32_t size);

// 0, or RUNG_CHANNEL_SETTING.
int32_t checkSerialSettings(const rung_channel_settings& settings);
// How long characters take on the line.
int64_t lineNs(const rung_channel_settings& settings, uint64_t characters);

}  // namespace rung::host
