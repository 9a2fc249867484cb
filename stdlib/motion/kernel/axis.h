// SPDX-License-Identifier: Apache-2.0
// The axis kernel: what all motion blocks share. An AXIS_REF_SM3 has one owner, the command that moves it. The owner's
// block computes the set values of the cycle when it is called; beforeTask and afterTask exchange them with the drive
// and watch the axis. In: commands of blocks; out: set values, states and errors.
//
// Positions in here count from the start of the axis without a jump, also on a modulo axis; `origin_` is what the
// program sees as 0. So setting a position changes nothing but `origin_`.
//
// Set values of a cycle come from the state at its begin (base_…), so they may be computed again when another command
// takes over in the same cycle. beforeTask makes the state at the end the state at the begin.
#pragma once

#include "profile/profile.h"
#include "rung/code.h"
#include "rung/motion.h"
#include "rung/native_blocks.h"

namespace rung::motion {

using Axis = rung_sm3_basic::AXIS_REF_SM3_type;
using Command = rung_sm3_basic::AXIS_COMMAND_type;
using Request = rung_sm3_basic::AXIS_REQUEST_type;
using Added = rung_sm3_basic::AXIS_ADDED_MOTION_type;
using Error = rung_sm3_basic::SMC_ERROR_type;
using AxisState = rung_sm3_basic::SMC_AXIS_STATE_type;

// The kind of command that moves the axis.
enum class Motion : uint8_t {
  None,
  Position,    // to a position
  Continuous,  // to a position, and on with the end velocity
  Velocity,    // with the end velocity, for ever
  Follow,      // the owner's block gives the set values: a table, a master, a drive that homes
  Brake,       // to rest, without an owner: after an error, or without release
};

// Commands that wait for others: AXIS_REF_SM3.waiting.
constexpr size_t kMostWaiting = 8;

enum class Outcome : uint8_t { Idle, Running, Done, Aborted, Failed };

// ---- cycle (cycle.cpp)

void beforeTask(const rung_context* ctx, Axis& axis);
void afterTask(const rung_context* ctx, Axis& axis);

// Ends all commands of the axis with an error and brakes it: errorstop.
void fail(Axis& axis, Error error);
bool isPowered(const Axis& axis);
bool isMoving(const Axis& axis);

// ---- the drive before it gets power, and its objects (configuration.cpp)

// One cycle: writes start-up objects, then checks the process data. The axis has no power before it is complete.
void configure(const rung_context* ctx, Axis& axis);
// One cycle of an access by the service channel: a rung_object_result.
int64_t accessObject(const rung_context* ctx, Axis& axis, rung_sm3_basic::AXIS_OBJECT_ACCESS_type& access);

// ---- motion (motion.cpp)

// Why the axis accepts no motion: SMC_NO_ERROR when it does. `axis` may be null.
Error refusal(const Axis* axis);
// False when `axis` is null or not an axis.
bool isAxis(const Axis* axis);

// A number is finite and above 0; finite.
bool isPositive(double value);
bool isFinite(double value);

// The set values at the begin of the cycle, with what is superimposed; where the last command ended in this cycle,
// those of its end.
State startState(const Axis& axis);
// The state in which a request begins: that at the end of the buffer where it has a target, if the request waits.
State beginState(const Axis& axis, const Request& request);
// The period of positions, 0: linear. A position as the program sees it.
double period(const Axis& axis);
double shown(const Axis& axis, double position);
// The kernel's position for one that the program gives.
double inner(const Axis& axis, double position);
// The target on a modulo axis for a direction, from where the request will begin; `direction` is an MC_Direction.
double turned(const Axis& axis, const Request& request, double position, int16_t direction);
// Sets the target for a position of a modulo axis. That of a command that waits for one without a target is found when
// it begins.
void aim(const Axis& axis, Request& request, double position, int16_t direction);

// The plan of a request from a state, with the factors of the override.
Result plan(const Axis& axis, const Request& request, const State& from, Profile& profile);
// The same without the velocity factor, for a block whose velocity comes from elsewhere; the ramps are scaled.
Result planUnscaled(Axis& axis, const Request& request, const State& from, Profile& profile);

// Tells whether the command with this serial is in the buffer.
bool isWaiting(const Axis& axis, uint32_t serial);
// Makes a new command the owner, or puts it into the buffer. Returns false when the request cannot be planned, when the
// buffer is full, and when a command would wait for itself.
bool begin(Axis& axis, Command& command, const Request& request);
// The owner with new parameters.
bool renew(Axis& axis, const Command& command, const Request& request);
// A superimposed motion; a shift of the master.
bool beginExtra(Axis& axis, Command& command, const Request& request);
bool beginPhase(Axis& axis, Command& command, const Request& request);
// The superimposed motion becomes part of the motion, and its command is aborted.
void mergeExtra(Axis& axis);

// Computes the set values of this cycle, once.
void advance(Axis& axis);
// The set values from the block that owns a Follow. A step that is too far stops the axis where it is: error 40.
void follow(Axis& axis, const State& state);
// Tells whether the axis would need more than fMaxVelocity to be there at the end of this cycle.
bool isStepTooFar(const Axis& axis, double position);
// The axis loses its owner, which is done or aborted: it rests, or goes on with its velocity in continuous motion.
void release(Axis& axis, Outcome outcome = Outcome::Done);
// The buffered command, if there is one, takes over at the end of this cycle.
bool handOver(Axis& axis, Outcome outcome);
// The shift of the master at the end of this cycle.
State phaseState(Axis& axis);
// From now on the program sees the set position as this.
void showAt(Axis& axis, double position);
// Of an axis without power: increments of the drive in one unit, and the period of positions. The drive stays where it
// is.
void rescale(Axis& axis, double increments, double position_period);
// The object 6060h, which the drive is to control, for an SMC_CONTROLLER_MODE, 0: not supported.
int8_t driveMode(int16_t controller_mode);
// The profile of the owner is over: InVelocity, InEndVelocity.
bool isProfileOver(const Axis& axis);

// ---- calls of blocks (call.cpp)

// One call of a block with Execute. The outcome of its command is that of this call.
class Call {
 public:
  Call(Axis* axis, Command& command, bool execute);

  bool rises() const { return rises_; }
  bool isRunning() const { return outcome() == Outcome::Running; }
  bool isOwner() const;
  // The owner of a Follow computes set values, but not in the cycle at whose end it took over from another command.
  bool follows() const { return isOwner() && axis_->handed_over_ != axis_->cycle_; }
  bool is(Outcome outcome) const { return outcome == this->outcome(); }
  Axis& axis() const { return *axis_; }

  // The block shows an error; a command that it has goes on.
  void refuse(Error error);
  // Begins the request, or refuses with `error` when it cannot be planned.
  void start(const Request& request, Error error);
  void done();
  // A command that does not move the axis, and that no other one aborts.
  void launch();
  // The owner computes the set values.
  void run();
  // Looks again at what became of the command.
  void update();
  // For the outputs: call it last, once.
  void show(uint8_t& busy, uint8_t& error, int16_t& error_id);

 private:
  Outcome outcome() const { return static_cast<Outcome>(command_.outcome_); }

  Axis* axis_;
  Command& command_;
  bool rises_;
};

}  // namespace rung::motion
