// recorder.h - what the uSD deck writes of a flight, so that fly --replay can fly it again on the desk.
//
// The deck takes 20 variables an event (tools/usd/config.txt says which). It copies them while the event is
// triggered, here in the stabilizer's own task, so that nothing changes between two variables of a row.
//
//   indiCall   every call: gyro, accelerometer, what was applied and what is commanded
//   indiState  the estimate and the range sample, in a call in which they changed
//   indiSet    the set point, likewise (one of its modes has no room there and stands in indiState)
//
// A row for which the card's buffer has no room is lost, and nothing in the file says so. So every call
// carries its number and those of the state and the set point that it flew, and all three are written anew
// every 100 calls or a few more: a loss shows, and lasts a tenth of a second at most. Each row has its stamp
// at both ends, in case it is written from another task some day.
#ifndef FIRMWARE_RECORDER_H
#define FIRMWARE_RECORDER_H

#define RECORDER_ANEW_MS 100

// Call at the end of each call of the app.
void recorder_call(void);

#endif
