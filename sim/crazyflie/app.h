// app.h - stand-in: what an app has to define.
#ifndef CRAZYFLIE_APP_H
#define CRAZYFLIE_APP_H

void appMain(void);

#endif
