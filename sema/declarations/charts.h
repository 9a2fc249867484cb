// SPDX-License-Identifier: Apache-2.0
// Scheduling of charts (SFC). In: the context of the POU whose chart is scheduled.
#pragma once

#include "frontend/schedule/sfc_schedule.h"
#include "sema/context.h"

namespace rung::sema {

text::Charts chartsOf(const Context& context);
text::ChartContext chartContextOf(const Context& context, PouId pou);

}  // namespace rung::sema
