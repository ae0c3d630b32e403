// client.h - what the client on the ground is notified of: every parameter that is not what it wrote.
//
// The firmware answers a write with the value that was written, before the app has judged it. A client that
// is not notified goes on showing what was refused.
#ifndef FIRMWARE_CLIENT_H
#define FIRMWARE_CLIENT_H

// Called by the firmware's parameter task after every write: has it judged, and notifies of what was put
// back. A commit is notified of when a tick has taken or refused it, which this waits for.
void client_wrote(void);

#endif
