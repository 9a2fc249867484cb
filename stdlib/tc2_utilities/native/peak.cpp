// Native body of the toy TOY_PEAK in peak.st.
#include "rung/native_blocks.h"

void rung_tc2_utilities_TOY_PEAK(rung_context*, rung_tc2_utilities::TOY_PEAK_type* self) {
  if (self->x_ > self->peak_) self->peak_ = self->x_;
}
