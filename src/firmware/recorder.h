// recorder.h - what the uSD deck can write of a flight, so that it can be flown again on the desk (fly
// --replay).
//
// The deck takes 20 variables an event (tools/usd/config.txt says which) and copies them while the event is
// triggered, here in the stabilizer's own task: nothing changes between two variables of a row.
//
//   indiCall   every call: gyro, accelerometer, what was applied and what is commanded
//   indiState  the estimate and the range sample, in a call in which they changed
//   indiSet    the set point, likewise (one of its modes has no room there and stands in indiState)
//
// A row for which the card's buffer has no room is lost, and nothing in the file says so. Hence every call
// carries its number and those of the state and the set that it flew, and all three are written anew every
// 100 calls or few more: what is lost is seen, and is lost for a tenth of a second at most. Each row has its
// stamp at both ends, should someone have it written from another task.
#ifndef FIRMWARE_RECORDER_H
#define FIRMWARE_RECORDER_H

#define RECORDER_ANEW_MS 100

// At the end of a call of the app.
void recorder_call(void);

#endif
