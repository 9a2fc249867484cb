/* SPDX-License-Identifier: Apache-2.0 */
/* What plant_tasks.c asks of an RTOS, and of the board. Each function is a line or two over a real one:
 *
 *                     FreeRTOS                                  Zephyr
 *   rtos_create       xTaskCreateStatic                         k_thread_create
 *   rtos_start        vTaskStartScheduler                       (runs already)
 *   rtos_now          xTaskGetTickCount                         k_uptime_ticks
 *   rtos_sleep_until  vTaskDelayUntil                           k_sleep(K_TIMEOUT_ABS_TICKS(tick))
 *   rtos_wait         ulTaskNotifyTake(pdTRUE, portMAX_DELAY)   k_sem_take(&task->sem, K_FOREVER)
 *   rtos_notify       vTaskNotifyGiveFromISR                    k_sem_give
 *   rtos_lock/unlock  taskENTER_CRITICAL / taskEXIT_CRITICAL    k_sched_lock / k_sched_unlock
 *   plant_tick        vApplicationTickHook                      the handler of a k_timer
 *
 * host/ has one on pthreads with virtual time. */
#ifndef RTOS_H
#define RTOS_H

#include <stddef.h>
#include <stdint.h>

#define RTOS_TICK_NS 1000000  /* 1 kHz */
#define RTOS_PRIORITIES 8     /* 0 is that of the idle task, 7 the most urgent */
#define RTOS_STACK_BYTES 3072 /* of a task of the plant: text of a REAL alone needs 1.5 KB */

typedef struct rtos_task {
  uint64_t control_block[16]; /* the RTOS's own: StaticTask_t, struct k_thread */
} rtos_task;

void rtos_create(rtos_task* task, const char* name, void (*run)(void* argument), void* argument, unsigned priority,
                 void* stack, size_t stack_bytes);
void rtos_start(void); /* does not return on a board */
uint32_t rtos_now(void);
void rtos_sleep_until(uint32_t tick); /* of the calling task */
void rtos_wait(void);                 /* until somebody has notified the calling task */
void rtos_notify(rtos_task* task);    /* also from an interrupt */
void rtos_lock(void);                 /* no other task of the plant runs until rtos_unlock */
void rtos_unlock(void);

/* Of the board. */
void board_read(uint8_t* inputs, size_t bytes);
void board_write(const uint8_t* outputs, size_t bytes);

/* Of plant_tasks.c: called by the RTOS at each tick, from its interrupt. */
void plant_tick(void);

#endif
