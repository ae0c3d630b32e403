// client.h - notifies the client on the ground of every parameter that is not what it wrote.
//
// The firmware answers a write with the value that was written, before the app has judged it. Without a
// notification the client would go on showing a refused value.
#ifndef FIRMWARE_CLIENT_H
#define FIRMWARE_CLIENT_H

// Called by the firmware's parameter task after every write. Has the write judged, and notifies the client of
// values that were put back. If a commit is pending, waits until a tick has taken or refused it, and notifies
// of that, too.
void client_wrote(void);

#endif
